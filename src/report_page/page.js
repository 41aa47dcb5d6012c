// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shows the report: its words and figures, then the two meshes. Text of the report only ever
// becomes text of the page, never markup.
'use strict';
(function () {
const report = JSON.parse(document.getElementById('report').textContent);
const views = JSON.parse(document.getElementById('views').textContent);
const viridis = [[68, 1, 84], [65, 68, 135], [42, 120, 142], [34, 168, 132], [122, 209, 81],
  [253, 231, 37]];

// Words

function element(parent, tag, text, name) {
  const result = document.createElement(tag);
  if (text !== undefined) result.textContent = text;
  if (name) result.className = name;
  parent.appendChild(result);
  return result;
}
const labels = {
  euler: 'Euler characteristic', Q_max: 'worst quality Q', Q_avg: 'mean quality Q',
  Q_le_2: 'faces with Q \u2264 2, %', angle_min: 'smallest angle, \u00b0',
  angle_max: 'largest angle, \u00b0', curve_bound: 'bound of ridges and borders',
  largest_normal_deviation: 'largest turn of a normal, \u00b0'};
function words(name) { return labels[name] || name.replace(/_/g, ' '); }
function show(value) {
  if (typeof value === 'boolean') return value ? 'yes' : 'no';
  if (typeof value === 'string') return value === '' ? 'none' : value;
  if (typeof value !== 'number') return JSON.stringify(value);
  if (Number.isInteger(value)) return value.toLocaleString('en');
  const size = Math.abs(value);
  return size < 1e-3 || size >= 1e6 ? value.toExponential(3) : String(Number(value.toPrecision(5)));
}
// An upper bound that is shown with fewer digits must stay one, and below its limit if it is.
function showBound(value, limit) {
  for (let digits = 5; value > 0 && digits < 17; ++digits) {
    let rounded = Number(value.toPrecision(digits));
    if (rounded < value)
      rounded = Number((value + Math.pow(10, Math.floor(Math.log10(value)) + 1 - digits))
        .toPrecision(digits));
    if (rounded <= limit || value > limit) return String(rounded);
  }
  return String(value);
}
function fileName(path) { return path.replace(/^.*[\\/]/, ''); }

const cards = document.getElementById('cards');
function card(title) {
  const result = element(cards, 'section', undefined, 'card');
  element(result, 'h2', title);
  return result;
}
function table(parent, head, rows) {
  const result = element(parent, 'table');
  if (head) {
    const row = element(element(result, 'thead'), 'tr');
    head.forEach(text => { element(row, 'th', text).scope = 'col'; });
  }
  const body = element(result, 'tbody');
  rows.forEach(cells => {
    const row = element(body, 'tr');
    cells.forEach((text, i) => {
      const cell = element(row, i ? 'td' : 'th', text);
      if (!i) cell.scope = 'row';
    });
  });
}

const certificate = report.certificate;
const checks = [['certificate_check', 'the record of the proof, read again'],
  ['distance_check', 'the distance of the two meshes, measured']]
  .filter(([name]) => certificate[name]);
const isProven = certificate.holds && checks.every(([name]) => certificate[name].holds);

function showHead() {
  const title = fileName(report.input.file) + ' \u2192 ' + fileName(report.output.file);
  document.title = title + ' \u2013 Surety';
  document.getElementById('title').textContent = title;
  document.getElementById('command').textContent
    = report.program + ' ' + report.command + ' ' + report.version;
  const verdict = document.getElementById('verdict');
  verdict.textContent = !isProven ? '\u2717 not certified'
    : checks.length ? '\u2713 certified and checked' : '\u2713 certified, not checked';
  verdict.classList.add(isProven ? 'good' : 'bad');
  const tile = (value, text) => {
    const result = element(document.getElementById('tiles'), 'div', undefined, 'tile');
    element(result, 'b', value);
    element(result, 'span', text);
  };
  const faces = report.output.faces, before = report.input.faces;
  tile(show(before) + ' \u2192 ' + show(faces), 'faces: ' + show(100 * faces / before)
    + ' % of the input');
  tile(showBound(certificate.bound, certificate.tolerance), 'proven distance, either way');
  tile(showBound(100 * certificate.bound / report.input.diagonal,
    100 * certificate.tolerance / report.input.diagonal) + ' %',
    'of the diagonal; ' + show(100 * certificate.tolerance / report.input.diagonal)
    + ' % allowed');
  tile(show(report.output.Q_avg), 'mean quality (1 is best), was ' + show(report.input.Q_avg));
  const total = Object.values(report.seconds).reduce((sum, s) => sum + s, 0);
  tile(show(Number(total.toPrecision(3))) + ' s', 'from reading to writing');
}

function showCertificate() {
  const parent = card('Certificate');
  element(parent, 'p', 'No point of either surface is farther than the bound from the other one.',
    'plain');
  const share = certificate.bound / certificate.tolerance;
  const meter = element(element(parent, 'div', undefined, 'meter'), 'i');
  meter.style.width = Math.min(100, 100 * share) + '%';
  const rows = [['tolerance', show(certificate.tolerance)], ['bound', showBound(certificate.bound, certificate.tolerance)],
    ['bound / tolerance', show(Number(share.toPrecision(4)))], ['kind of bound', certificate.policy],
    ['holds', show(certificate.holds)]];
  table(parent, null, rows);
  checks.forEach(([name, text]) => {
    element(parent, 'h3', 'Checked independently: ' + text);
    table(parent, null, Object.entries(certificate[name]).map(
      ([k, v]) => [words(k), /bound/.test(k) ? showBound(v, certificate.tolerance) : show(v)]));
  });
  if (!checks.length) element(parent, 'h3', 'Not checked independently, as was asked for.');
}

function showMeshes() {
  const parent = card('Meshes');
  const names = Object.keys(report.input).filter(
    name => typeof report.input[name] === 'number' && name in report.output);
  table(parent, ['', 'before', 'after'],
    names.map(name => [words(name), show(report.input[name]), show(report.output[name])]));
  if (report.features)
    element(parent, 'p', show(report.features.ridges) + ' ridge edges and '
      + show(report.features.corners) + ' corners of the input were kept.', 'below');
}

// Bars: the share of each bin, one or two series.

function drawBars(parent, series) {
  const space = 'http://www.w3.org/2000/svg', width = 320, height = 120;
  const draw = (where, tag, attributes, text) => {
    const result = document.createElementNS(space, tag);
    Object.entries(attributes).forEach(([name, value]) => result.setAttribute(name, value));
    if (text !== undefined) result.textContent = text;
    where.appendChild(result);
    return result;
  };
  const bins = series[0].bins, slot = width / bins.length;
  const shares = series.map(({bins}) => {
    const sum = bins.reduce((s, bin) => s + bin.number, 0) || 1;
    return bins.map(bin => bin.number / sum);
  });
  const largest = Math.max(...shares.map(s => Math.max(...s))) || 1;
  const svg = draw(parent, 'svg', {viewBox: `0 0 ${width} ${height + 26}`, role: 'img'});
  const bar = slot * .8 / series.length;
  shares.forEach((share, s) => share.forEach((value, i) => {
    const high = value / largest * (height - 14);
    const rectangle = draw(svg, 'rect', {x: i * slot + slot * .1 + s * bar, y: height - high,
      width: bar - 1, height: high, rx: 1.5, class: 'bar-' + series[s].name});
    draw(rectangle, 'title', {}, series[s].name + ': ' + show(series[s].bins[i].number) + ', '
      + (100 * value).toFixed(1) + ' %');
    if (value > 0 && s === series.length - 1)
      draw(svg, 'text', {x: i * slot + slot * .1 + (s + .5) * bar, y: height - high - 4,
        'text-anchor': 'middle'}, (100 * value).toFixed(value < .1 ? 1 : 0) + ' %');
  }));
  draw(svg, 'line', {x1: 0, x2: width, y1: height + .5, y2: height + .5, class: 'axis'});
  bins.forEach((bin, i) => {
    if (bin.up_to !== undefined && bin.up_to !== null)
      draw(svg, 'text', {x: (i + 1) * slot, y: height + 14, 'text-anchor': 'middle'},
        String(Number(bin.up_to.toPrecision(3))));
  });
  const key = element(parent, 'p', undefined, 'key');
  series.forEach(({name}) => {
    const item = element(key, 'span');
    element(item, 'i').style.background = `var(--${name === 'after' ? 'accent' : 'before'})`;
    item.appendChild(document.createTextNode(name));
  });
}

function showHistograms() {
  const quality = card('Quality of faces');
  element(quality, 'p', 'Q is 1 for the equilateral triangle and grows without bound; labels are '
    + 'shares after.', 'plain');
  drawBars(quality, [{name: 'before', bins: views[0].qualities},
    {name: 'after', bins: views[1].qualities}]);
  const metric = report.output.metric;
  if (!metric || !metric.lengths) return;
  const lengths = card('Lengths of edges in the metric');
  element(lengths, 'p', show(metric.unit_edges) + ' % are unit edges, from 0.71 to 1.41; '
    + 'the efficiency index is ' + show(metric.efficiency_index) + '.', 'plain');
  drawBars(lengths, [{name: 'after', bins: metric.lengths}]);
}

function showRest() {
  const parameters = card('Parameters');
  table(parameters, null, Object.entries(report.parameters).map(([k, v]) => [words(k), show(v)]));
  const operations = card('Operations');
  table(operations, ['performed', ''],
    Object.entries(report.operations.performed).map(([k, v]) => [words(k), show(v)]));
  const refused = Object.entries(report.operations.refused).filter(entry => entry[1] > 0)
    .sort((a, b) => b[1] - a[1]);
  if (refused.length) {
    element(operations, 'h3', ' ');
    table(operations, ['refused', ''], refused.map(([k, v]) => [words(k), show(v)]));
  }
  const timings = card('Time'), steps = element(timings, 'div', undefined, 'steps');
  const entries = Object.entries(report.seconds);
  entries.forEach(([name, seconds], i) => {
    const step = element(steps, 'i');
    step.style.flexGrow = Math.max(seconds, 1e-9);
    step.style.background = colorAt(entries.length > 1 ? i / (entries.length - 1) : 0);
    step.title = words(name);
  });
  table(timings, ['step', 'seconds'],
    entries.map(([name, seconds]) => [words(name), seconds.toPrecision(3)]));
  document.getElementById('footer').textContent = 'Coordinates in the pictures have 16 bits, '
    + 'colours 8. Figures are those of the full meshes. The same as data: --report FILE.json.';
}

// Pictures

function mix(t) {
  const x = Math.min(Math.max(t, 0), 1) * (viridis.length - 1);
  const i = Math.min(Math.floor(x), viridis.length - 2), f = x - i;
  return viridis[i].map((c, k) => c * (1 - f) + viridis[i + 1][k] * f);
}
function colorAt(t) { return `rgb(${mix(t).map(Math.round)})`; }

function decode(text, Type) {
  const raw = atob(text), bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  // Written with the least significant byte first, whatever this machine does.
  const size = Type.BYTES_PER_ELEMENT, result = new Type(bytes.length / size);
  for (let i = 0; i < result.length; ++i)
    for (let k = size; k--;) result[i] = result[i] * 256 + bytes[i * size + k];
  return result;
}

function edgesOf(faces, vertices) {
  const result = [], known = new Set();
  for (let i = 0; i < faces.length; ++i) {
    const a = faces[i], b = faces[i % 3 === 2 ? i - 2 : i + 1];
    const name = Math.min(a, b) * vertices + Math.max(a, b);
    if (known.has(name)) continue;
    known.add(name);
    result.push(a, b);
  }
  return result;
}

function addMesh(scene, view) {
  const coordinates = decode(view.positions, Uint16Array);
  const faces = decode(view.faces, view.index_bytes === 2 ? Uint16Array : Uint32Array);
  const points = new Float32Array(coordinates.length);
  for (let i = 0; i < points.length; ++i)
    points[i] = coordinates[i] * view.step + view.origin[i % 3];
  const corners = new Float32Array(3 * faces.length);
  for (let i = 0; i < faces.length; ++i)
    for (let k = 0; k < 3; ++k) corners[3 * i + k] = points[3 * faces[i] + k];
  const surface = new THREE.BufferGeometry();
  surface.setAttribute('position', new THREE.BufferAttribute(corners, 3));
  surface.setAttribute('color', new THREE.BufferAttribute(new Float32Array(corners.length), 3));
  surface.computeVertexNormals();
  scene.add(new THREE.Mesh(surface, new THREE.MeshPhongMaterial({
    vertexColors: THREE.VertexColors, side: THREE.DoubleSide, shininess: 8, specular: 0x111111,
    polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1})));
  const lines = new THREE.BufferGeometry();
  lines.setAttribute('position', new THREE.BufferAttribute(points, 3));
  const edges = edgesOf(faces, points.length / 3);
  lines.setIndex(new THREE.BufferAttribute(new Uint32Array(edges), 1));
  // Where faces are small, dark edges would hide what they enclose.
  const opacity = Math.min(.45, Math.max(.08, 60 / Math.sqrt(edges.length / 2)));
  const wires = new THREE.LineSegments(lines, new THREE.LineBasicMaterial({
    color: 0x10151c, transparent: true, opacity}));
  scene.add(wires);
  const values = view.fields.map(field => decode(field.values, Uint8Array));
  const paint = name => {
    const index = view.fields.findIndex(field => field.name === name);
    const colors = surface.attributes.color.array;
    for (let f = 0; f < faces.length / 3; ++f) {
      const color = index < 0 ? [178, 190, 205] : mix(values[index][f] / 255);
      for (let k = 0; k < 9; ++k) colors[9 * f + k] = color[k % 3] / 255;
    }
    surface.attributes.color.needsUpdate = true;
  };
  return {wires, paint};
}

function makeScene(view) {
  const scene = new THREE.Scene();
  scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8f98, .62));
  const light = new THREE.DirectionalLight(0xffffff, .5);
  scene.add(light, light.target);
  return Object.assign({scene, light}, addMesh(scene, view));
}

function makePane(view) {
  const pane = element(document.getElementById('panes'), 'div', undefined, 'pane');
  const caption = element(pane, 'p', view.title, 'caption');
  element(caption, 'span', view.note);
  return pane;
}

function hasWebGl() {
  const canvas = document.createElement('canvas');
  return Boolean(canvas.getContext('webgl') || canvas.getContext('experimental-webgl'));
}

function makeRenderer(pane) {
  const renderer = new THREE.WebGLRenderer({antialias: true, alpha: true});
  renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
  pane.appendChild(renderer.domElement);
  return renderer;
}

// Large input is centred and shrunk, so that depth has the same precision at every scale.
function normalise() {
  const low = views.map(v => v.origin), extent = Math.max(...views.map(v => v.step * 65535)) || 1;
  const middle = [0, 1, 2].map(k => views[0].origin[k] + views[0].size[k] / 2);
  views.forEach((view, i) => {
    view.origin = low[i].map((x, k) => (x - middle[k]) / extent);
    view.step /= extent;
  });
  return .5 * Math.hypot(...views[0].size) / extent;
}

function startViewer() {
  const panes = views.map(makePane);
  if (!hasWebGl()) {
    document.querySelectorAll('.caption span').forEach(
      text => { text.textContent = 'This browser has no WebGL: no picture.'; });
    return;
  }
  const radius = normalise();
  const shown = views.map((view, i) => Object.assign(makeScene(view),
    {renderer: makeRenderer(panes[i])}));
  // One camera for both views: they cannot but agree.
  const camera = new THREE.PerspectiveCamera(30, 1, radius / 50, radius * 50);
  let controls, upAxis = 'y';
  const render = () => shown.forEach(({renderer, scene, light}) => {
    light.position.copy(camera.position);
    light.target.position.copy(controls.target);
    renderer.render(scene, camera);
  });
  const reset = () => {
    if (controls) controls.dispose();
    camera.up.set(0, upAxis === 'y' ? 1 : 0, upAxis === 'z' ? 1 : 0);
    const direction = upAxis === 'y' ? new THREE.Vector3(.55, .35, 1)
      : new THREE.Vector3(.6, -1, .45);
    const spread = Math.sin(Math.PI / 12) * Math.min(1, camera.aspect);
    camera.position.copy(direction.normalize().multiplyScalar(.95 * radius / spread));
    controls = new THREE.OrbitControls(camera, document.getElementById('panes'));
    controls.minDistance = radius / 20;
    controls.maxDistance = radius * 20;
    controls.update();
    controls.addEventListener('change', render);
    render();
  };
  const resize = () => {
    const {clientWidth, clientHeight} = panes[0];
    camera.aspect = clientWidth / clientHeight;
    camera.updateProjectionMatrix();
    shown.forEach(({renderer}, i) => renderer.setSize(panes[i].clientWidth,
      panes[i].clientHeight, false));
    if (controls) render();
  };
  connect(shown, () => render(), reset, axis => { upAxis = axis; reset(); });
  resize();
  reset();
  window.addEventListener('resize', resize);
  document.documentElement.dataset.ready = 'yes';
}

function showLegend(field) {
  const legend = document.getElementById('legend');
  legend.textContent = '';
  if (!field) return;
  element(legend, 'span', show(field.low));
  element(legend, 'i').style.background = `linear-gradient(90deg, ${viridis.map(
    c => `rgb(${c})`)})`;
  element(legend, 'span', show(field.high) + (field.is_clamped ? ' or more' : ''));
}

function connect(shown, render, reset, turn) {
  const bar = document.getElementById('fields');
  const fields = views[1].fields.concat([{name: 'plain', label: 'plain'}]);
  const choose = field => {
    [...bar.children].forEach((button, i) => {
      button.setAttribute('aria-pressed', String(fields[i] === field));
    });
    shown.forEach(({paint}) => paint(field.name));
    showLegend(field.values === undefined ? null : field);
  };
  fields.forEach(field => {
    const button = element(bar, 'button', field.label);
    button.type = 'button';
    button.addEventListener('click', () => { choose(field); render(); });
  });
  choose(fields[0]);
  document.getElementById('wireframe').addEventListener('change', event => {
    shown.forEach(({wires}) => { wires.visible = event.target.checked; });
    render();
  });
  document.getElementById('reset').addEventListener('click', reset);
  document.getElementById('up').addEventListener('click', event => {
    const axis = event.target.textContent === 'up: y' ? 'z' : 'y';
    event.target.textContent = 'up: ' + axis;
    turn(axis);
  });
}

showHead();
showCertificate();
showHistograms();
showMeshes();
showRest();
startViewer();
})();
