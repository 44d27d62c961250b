// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_REPORT_WEB_PAGE_PARTS_H_
#define INVSIM_SRC_REPORT_WEB_PAGE_PARTS_H_

// Style and script of the page, word for word.

namespace invsim {

inline constexpr char kPageStyle[] = R"css(
:root { color-scheme: light dark; --ink: #222; --soft: #777; --paper: #fff;
  --line: #ddd; --stage: #eef0f2; }
@media (prefers-color-scheme: dark) { :root { --ink: #ddd; --soft: #999;
  --paper: #1b1c1e; --line: #3a3b3e; --stage: #26282b; } }
body { margin: 1.5rem auto; max-width: 72rem; padding: 0 1rem;
  font: 15px/1.45 system-ui, sans-serif; color: var(--ink);
  background: var(--paper); }
h1 { font-size: 1.3rem; margin: 0 0 .2rem; }
p { margin: .2rem 0 1rem; }
#viewer { position: relative; }
canvas { width: 100%; height: 32rem; display: block; touch-action: none;
  background: var(--stage); border-radius: 6px; cursor: grab; }
#controls { display: flex; flex-wrap: wrap; gap: .6rem; align-items: center;
  margin: .5rem 0 1rem; }
#controls input[type=range] { flex: 1 1 12rem; }
#clock { font-variant-numeric: tabular-nums; min-width: 9rem; }
#scale { color: var(--soft); }
.columns { display: grid; gap: 1rem 1.5rem;
  grid-template-columns: repeat(auto-fit, minmax(20rem, 1fr)); }
.columns > * { min-width: 0; }
table { border-collapse: collapse; }
td { padding: .12rem .8rem .12rem 0; border-bottom: 1px solid var(--line);
  vertical-align: top; overflow-wrap: anywhere; }
td:first-child { color: var(--soft); white-space: nowrap; }
svg.chart { width: 100%; margin-bottom: .6rem; }
svg.chart text { font: 11px system-ui, sans-serif; fill: var(--ink); }
svg.chart .grid { stroke: var(--line); }
svg.chart .cursor { stroke: var(--soft); stroke-dasharray: 3 2; }
pre { white-space: pre-wrap; border-top: 1px solid var(--line);
  padding-top: 1rem; font-size: 13px; }
)css";

inline constexpr char kPageScript[] = R"js(
'use strict';
(function () {
const data = JSON.parse(document.getElementById('data').textContent);
const canvas = document.getElementById('stage');
const gl = canvas.getContext('webgl', {antialias: true});
const note = document.getElementById('note');
if (!gl) {
  note.textContent = 'This browser offers no WebGL: the meshes are not shown. ' +
      'They are in scene.glb and in the folders body and cloth.';
  canvas.style.display = 'none';
  return;
}

function bytes(text) {
  const raw = atob(text), out = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) out[i] = raw.charCodeAt(i);
  return out;
}

// Smooth normals need positions on this side; they cost a millisecond a frame.
function normals(x, faces, out) {
  out.fill(0);
  for (let f = 0; f < faces.length; f += 3) {
    const a = 3 * faces[f], b = 3 * faces[f + 1], c = 3 * faces[f + 2];
    const ux = x[b] - x[a], uy = x[b + 1] - x[a + 1], uz = x[b + 2] - x[a + 2];
    const vx = x[c] - x[a], vy = x[c + 1] - x[a + 1], vz = x[c + 2] - x[a + 2];
    const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    for (const k of [a, b, c]) {
      out[k] += nx; out[k + 1] += ny; out[k + 2] += nz;
    }
  }
}

const vertexShader = `
attribute vec3 x; attribute vec3 n; attribute float q;
uniform mat4 view; uniform vec3 eye; uniform float behind;
varying vec3 normal; varying vec3 ray; varying float value;
void main() {
  normal = n; ray = eye - x; value = q;
  gl_Position = view * vec4(x, 1.0);
  vec4 deeper = view * vec4(x - behind * normalize(ray), 1.0);
  gl_Position.z = deeper.z / deeper.w * gl_Position.w;
}`;
const fragmentShader = `
precision mediump float;
uniform vec3 color; uniform float colored;
varying vec3 normal; varying vec3 ray; varying float value;
// Dark blue over green to yellow, ever lighter.
vec3 heat(float t) {
  vec3 a = vec3(0.19, 0.07, 0.33), b = vec3(0.13, 0.55, 0.55),
       c = vec3(0.99, 0.91, 0.14);
  return t < 0.5 ? mix(a, b, 2.0 * t) : mix(b, c, 2.0 * t - 1.0);
}
void main() {
  vec3 n = normalize(normal), e = normalize(ray);
  float front = dot(n, e);
  if (front < 0.0) n = -n;
  vec3 light = normalize(e + vec3(0.3, 0.6, 0.2));
  float shade = 0.35 + 0.65 * max(dot(n, light), 0.0);
  vec3 base = mix(color, heat(clamp(value, 0.0, 1.0)), colored);
  gl_FragColor = vec4(base * shade * (front < 0.0 ? 0.7 : 1.0), 1.0);
}`;
function compile(type, source) {
  const shader = gl.createShader(type);
  gl.shaderSource(shader, source);
  gl.compileShader(shader);
  return shader;
}
const program = gl.createProgram();
gl.attachShader(program, compile(gl.VERTEX_SHADER, vertexShader));
gl.attachShader(program, compile(gl.FRAGMENT_SHADER, fragmentShader));
gl.linkProgram(program);
gl.useProgram(program);
const at = name => gl.getAttribLocation(program, name);
const uniform = name => gl.getUniformLocation(program, name);
const wide = gl.getExtension('OES_element_index_uint');

const meshes = data.meshes.map(m => {
  const faceBytes = bytes(m.faces);
  const faces = new Uint32Array(faceBytes.buffer);
  const buffers = {};
  for (const name of ['x', 'n', 'q', 'index']) buffers[name] = gl.createBuffer();
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffers.index);
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER,
      wide ? faces : new Uint16Array(faces), gl.STATIC_DRAW);
  return {name: m.name, color: m.color, behind: m.behind,
    faces: faces, buffers: buffers,
    frames: m.frames.map(f => new Uint16Array(bytes(f).buffer)),
    values: m.values.map(bytes), quantity: m.quantity, most: m.most,
    x: new Float32Array(3 * m.vertices), n: new Float32Array(3 * m.vertices),
    q: new Float32Array(m.vertices), low: m.low, step: m.step,
    shown: true, colored: false};
});

const controls = document.getElementById('controls');
const slider = document.getElementById('time');
const clock = document.getElementById('clock');
const play = document.getElementById('play');
const scale = document.getElementById('scale');
slider.max = data.times.length - 1;
function box(label, on, change) {
  const element = document.createElement('label');
  const input = document.createElement('input');
  input.type = 'checkbox'; input.checked = on;
  input.onchange = () => { change(input.checked); draw(); };
  element.append(input, ' ' + label);
  controls.append(element);
}
for (const mesh of meshes) box(mesh.name, true, on => { mesh.shown = on; });
for (const mesh of meshes) {
  if (!mesh.quantity) continue;
  box('colour by ' + mesh.quantity, false, on => {
    mesh.colored = on;
    scale.textContent = meshes.filter(m => m.colored)
        .map(m => m.quantity + ': dark 0, yellow ' + m.most.toPrecision(3) +
                  ' and more').join('; ');
  });
}

let frame = 0, playing = false, started = 0;
let turn = 0.5, lift = 0.15, distance = 3, target = [0, 0, 0];
function load(k) {
  frame = k;
  slider.value = k;
  const low = [1e9, 1e9, 1e9], high = [-1e9, -1e9, -1e9];
  for (const m of meshes) {
    const raw = m.frames[k];
    for (let i = 0; i < raw.length; ++i) {
      const c = i % 3, value = m.low[c] + m.step * raw[i];
      m.x[i] = value;
      if (value < low[c]) low[c] = value;
      if (value > high[c]) high[c] = value;
    }
    normals(m.x, m.faces, m.n);
    if (m.values.length)
      for (let i = 0; i < m.q.length; ++i) m.q[i] = m.values[k][i] / 255;
    for (const name of ['x', 'n', 'q']) {
      gl.bindBuffer(gl.ARRAY_BUFFER, m.buffers[name]);
      gl.bufferData(gl.ARRAY_BUFFER, m[name], gl.DYNAMIC_DRAW);
    }
  }
  for (let c = 0; c < 3; ++c) target[c] = 0.5 * (low[c] + high[c]);
  if (!load.fitted) {
    distance = 1.25 * Math.hypot(high[0] - low[0], high[1] - low[1],
                                 high[2] - low[2]);
    load.fitted = true;
  }
  clock.textContent = data.times[k].toFixed(2) + ' s  (' + (k + 1) + ' / ' +
      data.times.length + ')';
  for (const svg of document.querySelectorAll('svg.chart')) {
    const line = svg.querySelector('.cursor');
    const share = (data.times[k] - svg.dataset.x0) /
        (svg.dataset.x1 - svg.dataset.x0);
    const left = +line.dataset.left, right = +line.dataset.right;
    const x = left + (right - left) * share;
    line.setAttribute('x1', x);
    line.setAttribute('x2', x);
    line.setAttribute('visibility', 'visible');
  }
}

function camera() {
  const eye = [target[0] + distance * Math.cos(lift) * Math.sin(turn),
    target[1] + distance * Math.sin(lift),
    target[2] + distance * Math.cos(lift) * Math.cos(turn)];
  const z = eye.map((e, c) => (e - target[c]) / distance);
  const right = [Math.cos(turn), 0, -Math.sin(turn)];
  const up = [z[1] * right[2] - z[2] * right[1],
    z[2] * right[0] - z[0] * right[2], z[0] * right[1] - z[1] * right[0]];
  const dot = a => a[0] * eye[0] + a[1] * eye[1] + a[2] * eye[2];
  const near = 0.02 * distance, far = 20 * distance;
  const fy = 1 / Math.tan(0.35), fx = fy * canvas.height / canvas.width;
  const p = (far + near) / (near - far), q = 2 * far * near / (near - far);
  const rows = [right, up, z];
  const view = new Float32Array(16);
  for (let c = 0; c < 3; ++c) {
    view[4 * c] = fx * right[c];
    view[4 * c + 1] = fy * up[c];
    view[4 * c + 2] = p * z[c];
    view[4 * c + 3] = -z[c];
  }
  view[12] = -fx * dot(rows[0]);
  view[13] = -fy * dot(rows[1]);
  view[14] = -p * dot(rows[2]) + q;
  view[15] = dot(rows[2]);
  gl.uniformMatrix4fv(uniform('view'), false, view);
  gl.uniform3fv(uniform('eye'), eye);
}

function draw() {
  const pixels = window.devicePixelRatio || 1;
  canvas.width = canvas.clientWidth * pixels;
  canvas.height = canvas.clientHeight * pixels;
  gl.viewport(0, 0, canvas.width, canvas.height);
  gl.clearColor(0, 0, 0, 0);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.enable(gl.DEPTH_TEST);
  camera();
  for (const m of meshes) {
    if (!m.shown) continue;
    for (const [name, size] of [['x', 3], ['n', 3], ['q', 1]]) {
      gl.bindBuffer(gl.ARRAY_BUFFER, m.buffers[name]);
      gl.enableVertexAttribArray(at(name));
      gl.vertexAttribPointer(at(name), size, gl.FLOAT, false, 0, 0);
    }
    gl.uniform3fv(uniform('color'), m.color);
    gl.uniform1f(uniform('behind'), m.behind);
    gl.uniform1f(uniform('colored'), m.colored ? 1 : 0);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, m.buffers.index);
    gl.drawElements(gl.TRIANGLES, m.faces.length,
        wide ? gl.UNSIGNED_INT : gl.UNSIGNED_SHORT, 0);
  }
}

function step(now) {
  if (!playing) return;
  const first = data.times[0], last = data.times[data.times.length - 1];
  // A pause of half a second before it starts again.
  const t = first + ((now - started) / 1000) % (last - first + 0.5);
  let k = 0;
  while (k + 1 < data.times.length && data.times[k + 1] <= t) ++k;
  if (k !== frame) { load(k); draw(); }
  requestAnimationFrame(step);
}
play.onclick = () => {
  playing = !playing;
  play.textContent = playing ? 'Pause' : 'Play';
  started = performance.now() - 1000 * (data.times[frame] - data.times[0]);
  if (playing) requestAnimationFrame(step);
};
slider.oninput = () => {
  if (playing) play.onclick();
  load(+slider.value);
  draw();
};
canvas.onpointerdown = e => canvas.setPointerCapture(e.pointerId);
canvas.onpointermove = e => {
  if (!e.buttons) return;
  turn -= 0.008 * e.movementX;
  lift = Math.min(1.5, Math.max(-1.5, lift + 0.008 * e.movementY));
  draw();
};
canvas.addEventListener('wheel', e => {
  e.preventDefault();
  distance *= Math.exp(0.001 * e.deltaY);
  draw();
}, {passive: false});
window.onresize = draw;
// "#frame=12" opens the page there.
const wanted = /frame=(\d+)/.exec(location.hash);
load(wanted ? Math.min(+wanted[1], data.times.length - 1) : 0);
draw();
})();
)js";

}  // namespace invsim

#endif  // INVSIM_SRC_REPORT_WEB_PAGE_PARTS_H_
