"use strict";
// The levels in 3D: what is drawn at a time. controls.js has the buttons and keys.

const viewer = (() => {
  const {Camera, freeAzimuth, dot, cross, unit} = orbit;

  function rgb(hex) {
    const value = parseInt(hex.trim().replace("#", ""), 16);
    return [(value >> 16 & 255) / 255, (value >> 8 & 255) / 255, (value & 255) / 255];
  }

  // Colours from dark blue to yellow, for values on nodes (viridis, at five places).
  const scale = ["#440154", "#3b528b", "#21918c", "#5ec962", "#fde725"].map(rgb);
  function shade(share) {
    const t = Math.min(1, Math.max(0, share)) * (scale.length - 1);
    const k = Math.min(scale.length - 2, Math.floor(t));
    return scale[k].map((v, i) => v + (t - k) * (scale[k + 1][i] - v));
  }

  // The corner positions of triangles or ends, one after the other.
  function gather(indices, values, into) {
    for (let i = 0; i < indices.length; ++i)
      for (let k = 0; k < 3; ++k) into[3 * i + k] = values[3 * indices[i] + k];
    return into;
  }

  function coloursOf(indices, colourOf) {
    const colours = new Float32Array(3 * indices.length);
    indices.forEach((index, i) => colours.set(colourOf(index), 3 * i));
    return colours;
  }

  // The surface of the base, drawn at the nodes of any level.
  class Surface {
    constructor(packed, palette, rest) {
      Object.assign(this, viewData.surface(packed));
      this.count = this.rows.start.length - 1;
      this.vertices = new Float32Array(3 * this.count);
      viewData.interpolate(this.rows, rest, this.vertices);
      const {group, vertex} = viewData.smoothGroups(this.triangles, this.vertices);
      this.group = group;
      this.normals = new Float32Array(3 * vertex.length);
      this.corners = new Float32Array(3 * this.triangles.length);
      this.cornerNormals = new Float32Array(3 * this.triangles.length);
      this.colours = coloursOf(this.triangles, (v) => palette[this.colour[v]]);
    }

    at(baseNodes) {
      viewData.interpolate(this.rows, baseNodes, this.vertices);
      this.normals.fill(0);
      for (let t = 0; t < this.triangles.length; t += 3) {
        const n = viewData.faceNormal(this.triangles, this.vertices, t);
        for (let k = 0; k < 3; ++k)
          for (let i = 0; i < 3; ++i) this.normals[3 * this.group[t + k] + i] += n[i];
      }
      return {position: [gather(this.triangles, this.vertices, this.corners), 3],
              normal: [gather(this.group, this.normals, this.cornerNormals), 3],
              colour: [this.colours, 3]};
    }
  }

  function boxArrays(box, colour) {
    const positions = [], normals = [];
    const turned = (v) => [0, 1, 2].map((i) => dot(box.rotation[i], v));
    for (let axis = 0; axis < 3; ++axis)
      for (const side of [-1, 1]) {
        const out = [0, 0, 0];
        out[axis] = side;
        for (const [u, v] of [[-1, -1], [1, -1], [1, 1], [-1, -1], [1, 1], [-1, 1]]) {
          const corner = [0, 0, 0];
          corner[axis] = side;
          corner[(axis + 1) % 3] = u;
          corner[(axis + 2) % 3] = v;
          const local = corner.map((c, i) => c * box.half_size[i]);
          positions.push(...turned(local).map((c, i) => c + box.center[i]));
          normals.push(...turned(out));
        }
      }
    return {position: [Float32Array.from(positions), 3], normal: [Float32Array.from(normals), 3],
            colour: [coloursOf([...Array(36).keys()], () => colour), 3]};
  }

  // A large square of a plane about the foot of `center`.
  function planeArrays(plane, center, reach) {
    const n = plane.normal;
    const u = unit(Math.abs(n[2]) > 0.7 ? cross([0, 1, 0], n) : cross([0, 0, 1], n));
    const v = cross(n, u);
    const height = dot(n, center) - plane.offset;
    const foot = center.map((c, i) => c - height * n[i]);
    const positions = [], across = [];
    for (const [a, b] of [[-1, -1], [1, -1], [1, 1], [-1, -1], [1, 1], [-1, 1]]) {
      const point = foot.map((c, i) => c + reach * (a * u[i] + b * v[i]));
      positions.push(...point);
      across.push(dot(point, u), dot(point, v));
    }
    return {arrays: {position: [Float32Array.from(positions), 3],
                     across: [Float32Array.from(across), 2]},
            shape: [dot(foot, u), dot(foot, v), reach]};
  }

  function niceLength(length) {
    const power = 10 ** Math.floor(Math.log10(length));
    return power * [1, 2, 5, 10].reduce((best, f) => f * power <= length ? f : best, 1);
  }

  class Viewer {
    // Throws if the browser has no WebGL 2.
    constructor(canvas, data) {
      this.canvas = canvas;
      const gl = canvas.getContext("webgl2", {alpha: false, antialias: true, stencil: true});
      if (!gl) throw new Error("This browser has no WebGL 2.");
      this.gl = gl;
      this.painter = new painter.Painter(gl);
      this.times = data.times;
      this.palette = data.palette.map(rgb);
      this.obstacles = data.obstacles || [];
      this.bodies = data.bodies.map((packed) => viewData.body(packed, data.times));
      this.values = data.values || null;
      const base = this.bodies[0];
      const rest = base.pose(0);
      this.surface = data.surface ? new Surface(data.surface, this.palette, rest) : null;
      this.baseNodes = new Float32Array(3 * base.nodes);
      const {middle, radius} = this.extent(rest);
      this.radius = radius;
      this.target = middle;
      this.camera = new Camera(freeAzimuth(this.obstacles),
        (this.times.length > 1 ? 1.3 : 1.05) * radius);
      this.boxes = this.obstacles.filter((o) => o.center);
      this.planes = this.obstacles.filter((o) => o.normal);
      Object.assign(this, {body: base, time: 0, mode: this.surface && !this.values ? "surface" : "springs",
                           ghost: false});
      for (const body of this.bodies) this.prepare(body);
    }

    extent(x) {
      const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
      for (let i = 0; i < x.length; ++i) {
        low[i % 3] = Math.min(low[i % 3], x[i]);
        high[i % 3] = Math.max(high[i % 3], x[i]);
      }
      const middle = low.map((v, i) => (v + high[i]) / 2);
      return {middle, radius: Math.hypot(...high.map((v, i) => v - low[i])) / 2 || 1};
    }

    prepare(body) {
      const ofNode = this.valueColours(body) || ((n) => this.palette[body.colour[n]]);
      body.endColours = coloursOf(body.ends, ofNode);
      body.nodeColours = coloursOf([...Array(body.nodes).keys()], ofNode);
      body.endPositions = new Float32Array(3 * body.ends.length);
      // About the mean distance of neighbours in a solid body.
      body.ball = 0.35 * this.radius / Math.cbrt(body.nodes);
    }

    valueColours(body) {
      const own = this.values && this.values.of[body.label];
      if (!own) return null;
      const {low, high} = this.values;
      return (n) => shade(high > low ? (own[n] - low) / (high - low) : 0.5);
    }

    // The middle of the body, averaged over 0.2 s to both sides, so that the camera glides.
    follow(body, t) {
      const middle = [0, 0, 0], steps = this.times.length > 1 ? [-0.2, -0.1, 0, 0.1, 0.2] : [0];
      for (const dt of steps) {
        const at = this.extent(body.pose(Math.max(0, t + dt))).middle;
        at.forEach((v, i) => { middle[i] += v / steps.length; });
      }
      return middle;
    }

    draw() {
      const {gl, canvas} = this;
      const ratio = Math.min(2, window.devicePixelRatio || 1);
      canvas.width = Math.round(canvas.clientWidth * ratio);
      canvas.height = Math.round(canvas.clientHeight * ratio);
      if (!canvas.width || !canvas.height) return;
      const style = getComputedStyle(canvas);
      const colour = (name) => rgb(style.getPropertyValue(name));
      const back = colour("--scene");
      gl.viewport(0, 0, canvas.width, canvas.height);
      gl.clearColor(...back, 1);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
      gl.enable(gl.DEPTH_TEST);
      gl.disable(gl.CULL_FACE);
      const target = this.follow(this.body, this.time);
      const {eye, matrix, pixels} = this.camera.at(target, canvas.width, canvas.height);
      const toEye = unit([eye[0] - target[0], eye[1] - target[1], 0]);
      const light = unit([0.5 * toEye[0] - 0.5 * toEye[1], 0.5 * toEye[1] + 0.5 * toEye[0], 1.1]);
      this.shared = {view: matrix, eye, light, plane: [0, 0, 1, 0], flat_: 0, tint: [0, 0, 0, 0],
                     alpha: 1, pixels};
      this.drawPlanes(target, eye, colour);
      for (const box of this.boxes)
        this.painter.draw("solid", gl.TRIANGLES, boxArrays(box, colour("--obstacle")), this.shared);
      this.drawBody(this.body, this.shared);
      if (this.ghost && this.body !== this.bodies[0]) this.drawGhost(colour("--ink"));
    }

    drawPlanes(target, eye, colour) {
      const {gl} = this;
      const reach = 9 * this.radius;
      for (const plane of this.planes) {
        if (dot(plane.normal, eye) < plane.offset) continue; // seen from behind
        const {arrays, shape} = planeArrays(plane, target, reach);
        gl.enable(gl.BLEND);
        gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
        this.painter.draw("ground", gl.TRIANGLES, arrays, {...this.shared,
          fill: colour("--ground"), tint: [...colour("--ground-line"), 1], shape,
          cell: niceLength(this.radius / 2)});
        if (plane.normal[2] > 0.7) this.drawShadow(plane);
        gl.disable(gl.BLEND);
      }
    }

    // Every pixel of the shadow once, by the stencil.
    drawShadow(plane) {
      const {gl} = this;
      gl.enable(gl.STENCIL_TEST);
      gl.clear(gl.STENCIL_BUFFER_BIT);
      gl.stencilFunc(gl.EQUAL, 0, 255);
      gl.stencilOp(gl.KEEP, gl.KEEP, gl.INCR);
      gl.disable(gl.DEPTH_TEST);
      this.drawBody(this.body, {...this.shared, plane: [...plane.normal, plane.offset], flat_: 1,
                                tint: [0, 0, 0, 1], alpha: 0.28});
      gl.enable(gl.DEPTH_TEST);
      gl.disable(gl.STENCIL_TEST);
    }

    nodesOfBase(body, pose) {
      return body.toBase ? viewData.interpolate(body.toBase, pose, this.baseNodes) : pose;
    }

    drawBody(body, uniforms) {
      const {gl} = this, pose = body.pose(this.time);
      if (this.mode === "surface" && this.surface) {
        this.painter.draw("solid", gl.TRIANGLES, this.surface.at(this.nodesOfBase(body, pose)),
                          uniforms);
        return;
      }
      if (body.ends.length)
        this.painter.draw("spring", gl.LINES,
          {position: [gather(body.ends, pose, body.endPositions), 3],
           colour: [body.endColours, 3]}, uniforms);
      this.painter.draw("node", gl.POINTS, {position: [pose, 3], colour: [body.nodeColours, 3]},
                        {...uniforms, size: body.ball * this.shared.pixels});
    }

    // The base at the same time, to see how far off the level is.
    drawGhost(ink) {
      const {gl} = this, base = this.bodies[0];
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
      gl.depthMask(false);
      this.drawBody(base, {...this.shared, tint: [...ink, 0.8], alpha: 0.25});
      gl.depthMask(true);
      gl.disable(gl.BLEND);
    }
  }

  return {Viewer, niceLength, shade};
})();
