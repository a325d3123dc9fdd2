"use strict";
// Vectors, matrices (by columns) and the orbiting camera of the 3D view. z is up.

const orbit = (() => {
  const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0]];
  function unit(a) {
    const length = Math.hypot(...a) || 1;
    return [a[0] / length, a[1] / length, a[2] / length];
  }

  function product(a, b) {
    const c = new Float32Array(16);
    for (let j = 0; j < 4; ++j)
      for (let i = 0; i < 4; ++i)
        for (let k = 0; k < 4; ++k) c[4 * j + i] += a[4 * k + i] * b[4 * j + k];
    return c;
  }

  function perspective(fov, aspect, near, far) {
    const f = 1 / Math.tan(fov / 2), d = 1 / (near - far);
    return [f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (near + far) * d, -1, 0, 0, 2 * near * far * d,
      0];
  }

  function lookAt(eye, target) {
    const back = unit(minus(eye, target));
    const right = unit(cross([0, 0, 1], back));
    const up = cross(back, right);
    return [right[0], up[0], back[0], 0, right[1], up[1], back[1], 0, right[2], up[2], back[2], 0,
      -dot(right, eye), -dot(up, eye), -dot(back, eye), 1];
  }

  const fov = 25 * Math.PI / 180; // vertical
  const highest = 1.45; // elevation [rad]: looking straight down, "up" has no direction

  // A camera about a target: angles in rad, distance in m.
  class Camera {
    constructor(azimuth, radius) {
      this.start = {azimuth, elevation: 0.26, zoom: 1};
      this.radius = radius; // of what must be seen
      this.reset();
    }

    reset() { Object.assign(this, this.start); }

    turn(across, up) {
      this.azimuth += across;
      this.elevation = Math.min(highest, Math.max(-0.2, this.elevation + up));
    }

    magnify(factor) { this.zoom = Math.min(20, Math.max(0.1, this.zoom * factor)); }

    // {eye, matrix, pixels}: pixels is the size on the screen of 1 m at 1 m from the eye.
    at(target, width, height) {
      const aspect = width / height;
      const seen = Math.sin(fov / 2) * Math.min(1, aspect);
      const distance = this.radius / seen / this.zoom;
      const flat = Math.cos(this.elevation) * distance;
      const eye = [target[0] + flat * Math.cos(this.azimuth),
        target[1] + flat * Math.sin(this.azimuth),
        target[2] + Math.sin(this.elevation) * distance];
      const projection = perspective(fov, aspect, distance / 50, distance * 50);
      return {eye, matrix: product(projection, lookAt(eye, target)),
              pixels: height / 2 / Math.tan(fov / 2)};
    }
  }

  // The usual azimuth, or the mirror image of it in which no wall is between eye and body.
  function freeAzimuth(obstacles) {
    const usual = -70 * Math.PI / 180;
    const walls = obstacles.filter((o) => o.normal && Math.abs(o.normal[2]) < 0.7);
    return [usual, -Math.PI - usual, -usual, Math.PI + usual].find((angle) => walls.every((wall) =>
      wall.normal[0] * Math.cos(angle) + wall.normal[1] * Math.sin(angle) >= 0.15)) ?? usual;
  }

  return {Camera, freeAzimuth, minus, dot, cross, unit};
})();
