"use strict";
// The shaders of the 3D view (WebGL 2) and what draws with them.

const painter = (() => {
  const head = "#version 300 es\nprecision highp float;\n";

  // Positions on a plane of height `offset` along `normal`, for shadows; as they are if flat = 0.
  const project = `
uniform mat4 view;
uniform vec4 plane; // normal, offset
uniform vec3 light; // towards it
uniform float flat_;
vec3 placed(vec3 x) {
  float t = (dot(plane.xyz, x) - plane.w) / dot(plane.xyz, light);
  return mix(x, x - t * light + 1e-4 * plane.xyz, flat_);
}
`;

  const sources = {
    // Surfaces and boxes: key light from above the eye, light from the sky, a soft highlight.
    solid: [`${project}
in vec3 position, normal, colour;
out vec3 at, n, c;
void main() {
  at = position; n = normal; c = colour;
  gl_Position = view * vec4(placed(position), 1.0);
}`, `
in vec3 at, n, c;
uniform vec3 eye, light;
uniform vec4 tint; // colour and how much of it replaces the body's
uniform float alpha;
out vec4 pixel;
void main() {
  vec3 away = normalize(eye - at);
  vec3 m = normalize(n);
  if (dot(m, away) < 0.0) m = -m;
  float key = max(dot(m, light), 0.0);
  float sky = 0.5 + 0.5 * m.z;
  float shine = pow(max(dot(m, normalize(light + away)), 0.0), 40.0);
  vec3 lit = c * (0.34 + 0.26 * sky + 0.55 * key) + 0.10 * shine;
  pixel = vec4(mix(lit, tint.rgb, tint.a), alpha);
}`],
    spring: [`${project}
in vec3 position, colour;
out vec3 c;
void main() { c = colour; gl_Position = view * vec4(placed(position), 1.0); }`, `
in vec3 c;
uniform vec4 tint;
uniform float alpha;
out vec4 pixel;
void main() { pixel = vec4(mix(c, tint.rgb, tint.a), alpha); }`],
    // Nodes as balls.
    node: [`${project}
in vec3 position, colour;
uniform float size; // [pixels at 1 m]
uniform vec3 eye;
out vec3 c;
void main() {
  c = colour;
  gl_Position = view * vec4(placed(position), 1.0);
  gl_PointSize = max(2.0, size / gl_Position.w);
}`, `
in vec3 c;
uniform vec4 tint;
uniform float alpha;
out vec4 pixel;
void main() {
  vec2 q = 2.0 * gl_PointCoord - 1.0;
  float r = dot(q, q);
  if (r > 1.0) discard;
  float lit = 0.55 + 0.45 * sqrt(1.0 - r) * (0.7 - 0.3 * q.y);
  pixel = vec4(mix(c * lit, tint.rgb, tint.a), alpha);
}`],
    // Floors and walls: a grid that fades with the distance from the middle.
    ground: [`${project}
in vec3 position;
in vec2 across;
out vec2 uv;
void main() { uv = across; gl_Position = view * vec4(position, 1.0); }`, `
in vec2 uv;
uniform vec4 tint; // lines
uniform vec3 fill;
uniform vec3 shape; // middle (u, v) and reach
uniform float cell;
out vec4 pixel;
float lines(float edge) {
  vec2 q = uv / edge;
  vec2 d = abs(fract(q - 0.5) - 0.5) / max(fwidth(q), 1e-6);
  return 1.0 - min(min(d.x, d.y), 1.0);
}
void main() {
  float fade = 1.0 - smoothstep(0.25, 1.0, length(uv - shape.xy) / shape.z);
  float line = max(0.45 * lines(cell), lines(5.0 * cell));
  pixel = vec4(mix(fill, tint.rgb, line * tint.a), fade);
}`],
  };

  function compile(gl, [vertex, fragment]) {
    const program = gl.createProgram();
    for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, head + source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
      throw new Error("shader: " + gl.getProgramInfoLog(program));
    const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS);
    const uniforms = {};
    for (let i = 0; i < count; ++i) {
      const {name, type} = gl.getActiveUniform(program, i);
      uniforms[name] = {place: gl.getUniformLocation(program, name), type};
    }
    return {program, uniforms};
  }

  // draw(kind, mode, arrays, uniforms): arrays are {name: [Float32Array, components]}.
  class Painter {
    constructor(gl) {
      this.gl = gl;
      this.programs = {};
      for (const [name, pair] of Object.entries(sources)) this.programs[name] = compile(gl, pair);
      this.buffers = new Map();
    }

    set(program, name, value) {
      const {gl} = this, uniform = program.uniforms[name];
      if (!uniform) return;
      switch (uniform.type) {
        case gl.FLOAT_MAT4: gl.uniformMatrix4fv(uniform.place, false, value); break;
        case gl.FLOAT_VEC4: gl.uniform4fv(uniform.place, value); break;
        case gl.FLOAT_VEC3: gl.uniform3fv(uniform.place, value); break;
        default: gl.uniform1f(uniform.place, value);
      }
    }

    draw(kind, mode, arrays, uniforms) {
      const {gl} = this, program = this.programs[kind];
      gl.useProgram(program.program);
      for (const [name, value] of Object.entries(uniforms)) this.set(program, name, value);
      let count = 0;
      const places = [];
      for (const [name, [array, components]] of Object.entries(arrays)) {
        const place = gl.getAttribLocation(program.program, name);
        if (place < 0) continue;
        const key = kind + name;
        if (!this.buffers.has(key)) this.buffers.set(key, gl.createBuffer());
        gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers.get(key));
        gl.bufferData(gl.ARRAY_BUFFER, array, gl.DYNAMIC_DRAW);
        gl.enableVertexAttribArray(place);
        gl.vertexAttribPointer(place, components, gl.FLOAT, false, 0, 0);
        places.push(place);
        count = array.length / components;
      }
      gl.drawArrays(mode, 0, count);
      for (const place of places) gl.disableVertexAttribArray(place);
    }
  }

  return {Painter};
})();
