// page.js - one triangle in a grid of voxels, and mesh files into voxels: what tribox.h answers, to look at
//
// The answers come from tribox_web.c, compiled to WebAssembly (tribox.js holds its bytes); three.bundle.js draws. No
// server is needed: index.html opens from a folder.
'use strict';

// ---- 1. WebAssembly: what the C code asks the page for, and instances of it

const page_text = new TextDecoder('latin1');
const PAGE_NUMBER = /^[+-]?(?:0x[0-9a-f]+|(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?|inf(?:inity)?|nan)/i;

// Is the decimal less than, equal to or greater than x? Exactly: both as whole numbers.
function compare_decimal(text, x) {
    const [, sign, whole, part = '', power = '0'] = /^([+-]?)(\d*)\.?(\d*)(?:e([+-]?\d+))?/i.exec(text);
    let tens = Number(power) - part.length;
    let decimal = BigInt((sign === '-' ? '-' : '') + (whole + part || '0'));
    let twos = 0;
    while (!Number.isInteger(x)) {
        x *= 2;
        twos++;
    }
    decimal *= 2n ** BigInt(twos);
    let other = BigInt(x);
    if (tens > 0) {
        decimal *= 10n ** BigInt(tens);
    } else {
        other *= 10n ** BigInt(-tens);
    }
    return decimal < other ? -1 : decimal > other ? 1 : 0;
}

// The float nearest to a decimal. Rounding the nearest double errs only where that lies half-way between two floats.
function nearest_float(text, x) {
    const near = Math.fround(x);
    const bits = new DataView(new ArrayBuffer(8));
    bits.setFloat64(0, x);
    if (!Number.isFinite(near) || (bits.getUint32(4) & 0x1fffffff) !== 0x10000000) {
        return near;
    }
    const side = compare_decimal(text, x);
    return side > 0 ? Math.max(near, 2 * x - near) : side < 0 ? Math.min(near, 2 * x - near) : near;
}

// x as C prints it with %f, %e or %g
function c_number(x, kind, digits) {
    if (!Number.isFinite(x)) {
        return Number.isNaN(x) ? 'nan' : x < 0 ? '-inf' : 'inf';
    }
    const with_power = (n) => x.toExponential(n).replace(/e([+-])(\d)$/, 'e$10$2');
    if (kind === 'f') {
        return x.toFixed(digits);
    }
    if (kind === 'e') {
        return with_power(digits);
    }
    const most = Math.max(digits, 1);
    const power = Number(/e(.*)/.exec(x.toExponential(most - 1))[1]);
    const text = power >= -4 && power < most ? x.toFixed(most - 1 - power) : with_power(most - 1);
    return text.includes('.') ? text.replace(/\.?0+(e|$)/, '$1') : text;
}

async function make_instance(module) {
    let memory;
    const imports = {
        text_number(text, is_float, length_at) {
            const bytes = new Uint8Array(memory.buffer, text, Math.min(400, memory.buffer.byteLength - text));
            let from = 0;
            while (bytes[from] === 32 || (bytes[from] >= 9 && bytes[from] <= 13)) {
                from++;
            }
            let end = from;
            while (end < bytes.length && (bytes[end] > 42 && bytes[end] < 123)) {
                end++;
            }
            const match = PAGE_NUMBER.exec(page_text.decode(bytes.subarray(from, end)));
            new DataView(memory.buffer).setInt32(length_at, match ? from + match[0].length : 0, true);
            if (!match) {
                return 0;
            }
            const word = match[0];
            const sign = word[0] === '-' ? -1 : 1;
            const bare = word.replace(/^[+-]/, '').toLowerCase();
            const x = bare.startsWith('inf') ? Infinity : bare === 'nan' ? NaN : Number(bare);
            return sign * (is_float && Number.isFinite(x) ? nearest_float(bare, x) : x);
        },
        number_text(x, kind, digits, out) {
            const text = c_number(x, String.fromCharCode(kind), digits);
            const bytes = new Uint8Array(memory.buffer, out, 400);
            for (let i = 0; i < text.length; i++) {
                bytes[i] = text.charCodeAt(i);
            }
            return text.length;
        },
        power: Math.pow,
        sine: Math.sin,
        cosine: Math.cos,
    };
    const { exports } = await WebAssembly.instantiate(module, { page: imports });
    memory = exports.memory;
    return {
        call: exports,
        numbers: () => new Float64Array(memory.buffer, exports.web_numbers(), 16),
        bytes: (at, size) => new Uint8Array(memory.buffer, at, size),
        text(at) {
            const bytes = new Uint8Array(memory.buffer, at);
            return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
        },
        put(bytes) {
            const at = exports.web_room(bytes.length + 2);
            if (at) {
                new Uint8Array(memory.buffer, at, bytes.length + 2).fill(0, bytes.length);
                new Uint8Array(memory.buffer, at, bytes.length).set(bytes);
            }
            return at;
        },
    };
}

// ---- 2. What is shown

const by_id = (id) => document.getElementById(id);
const count_text = (n) => n.toLocaleString('en-US');
const state = {
    mode: 'triangle',
    rule: 0,
    side: 10,
    size: Math.fround(0.1),
    corners: new Float32Array([0.2, 0.1, 0.3, 0.8, 0.3, 0.6, 0.3, 0.9, 0.7]),
    name: 'teapot',
    solid: false,
    resolution: 64,
    up: 'z',
};
const RULES = { 0: 'closed', 1: 'half-open', 2: 'open', 4: 'thin' };
let module;
let triangle_code;      // an instance for the triangle, one for each mesh
let triangle_at = 0;   // where its corners stand
let mesh_code;
let mesh_numbers;

function say(text, wrong) {
    by_id('said').textContent = text;
    by_id('said').classList.toggle('wrong', Boolean(wrong));
}

function show_numbers(rows) {
    by_id('numbers').replaceChildren(...rows.map(([name, value, bad]) => {
        const row = document.createElement('div');
        const term = document.createElement('dt');
        const number = document.createElement('dd');
        term.textContent = name;
        number.textContent = value;
        number.classList.toggle('bad', Boolean(bad));
        row.append(term, number);
        return row;
    }));
}

// ---- 3. Space: camera, light, drawing when something has changed

const canvas = by_id('view');
const renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(36, 1, 0.1, 10000);
const orbit = { yaw: 0.62, pitch: 0.5, far: 30, centre: new THREE.Vector3() };
const lamp = new THREE.DirectionalLight(0xffffff, 2.2);
lamp.position.set(-4, 8, 6);
scene.add(new THREE.AmbientLight(0xbfd0ff, 1.1), lamp);
let asked = false;

function place_camera() {
    const wide = canvas.clientWidth > 760;
    const { yaw, pitch, far, centre } = orbit;
    camera.position.set(centre.x + far * Math.cos(pitch) * Math.sin(yaw), centre.y + far * Math.sin(pitch),
        centre.z + far * Math.cos(pitch) * Math.cos(yaw));
    camera.lookAt(centre);
    camera.aspect = canvas.clientWidth / canvas.clientHeight;
    // the panel covers the right side, or the lower half
    camera.setViewOffset(canvas.clientWidth, canvas.clientHeight, wide ? 186 : 0, wide ? 0 : canvas.clientHeight * 0.24, canvas.clientWidth,
        canvas.clientHeight);
    camera.updateMatrixWorld();
}

function draw() {
    if (!asked) {
        asked = true;
        requestAnimationFrame(() => {
            asked = false;
            if (canvas.width !== Math.floor(canvas.clientWidth * devicePixelRatio)
                || canvas.height !== Math.floor(canvas.clientHeight * devicePixelRatio)) {
                renderer.setPixelRatio(devicePixelRatio);
                renderer.setSize(canvas.clientWidth, canvas.clientHeight, false);
            }
            place_camera();
            renderer.render(scene, camera);
            document.body.dataset.frames = Number(document.body.dataset.frames || 0) + 1;
        });
    }
}

// ---- 4. The triangle: world coordinates are voxels, y up

const triangle_view = new THREE.Group();
const CORNER_COLOURS = [0x46c9c0, 0x46c9c0, 0x46c9c0];
const triangle_positions = new THREE.BufferAttribute(new Float32Array(9), 3);
const triangle_shape = new THREE.BufferGeometry().setAttribute('position', triangle_positions);
const handles = CORNER_COLOURS.map((color) => new THREE.Mesh(new THREE.SphereGeometry(1, 32, 20), new THREE.MeshLambertMaterial({ color })));
const boxes = {};
const edges = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: 0xffc9a3, transparent: true, opacity: 0.4 }));
const cage = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: 0x93a5c4, transparent: true, opacity: 0.2 }));
for (const [name, color, opacity] of [['set', 0xef8a4b, 0.33], ['missed', 0xff5266, 0.6], ['extra', 0xa58bff, 0.6]]) {
    boxes[name] = new THREE.InstancedMesh(new THREE.BoxGeometry(0.96, 0.96, 0.96),
        new THREE.MeshLambertMaterial({ color, transparent: true, opacity, depthWrite: name !== 'set' }), 24 ** 3);
    boxes[name].frustumCulled = false;
    triangle_view.add(boxes[name]);
}
const sheet = new THREE.Mesh(triangle_shape, new THREE.MeshBasicMaterial({ color: 0x35b5ac, side: THREE.DoubleSide, transparent: true, opacity: 0.62, depthWrite: false }));
const border = new THREE.LineLoop(triangle_shape, new THREE.LineBasicMaterial({ color: 0xb6fff9 }));
sheet.renderOrder = 2;
border.renderOrder = 3;
triangle_view.add(sheet, border, edges, cage, ...handles);
scene.add(triangle_view);

// from the mesh's axes (z up) to the page's (y up), in voxels from the middle
const to_world = (v) => new THREE.Vector3(v[0] / state.size - state.side / 2, v[2] / state.size - state.side / 2, state.side / 2 - v[1] / state.size);
const to_corner = (p) => [(p.x + state.side / 2) * state.size, (state.side / 2 - p.z) * state.size, (p.y + state.side / 2) * state.size];

function draw_cage() {
    const n = state.side;
    const h = n / 2;
    const points = [];
    for (let i = 0; i <= n; i++) {
        points.push(i - h, -h, -h, i - h, -h, h, -h, -h, i - h, h, -h, i - h);          // floor
        points.push(i - h, -h, -h, i - h, h, -h, -h, i - h, -h, h, i - h, -h);          // back
        points.push(-h, i - h, -h, -h, i - h, h, -h, -h, i - h, -h, h, i - h);          // left
    }
    cage.geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(points), 3));
    cage.geometry.computeBoundingSphere();
}

const BOX_EDGES = [0, 1, 2, 3, 4, 5, 6, 7, 0, 2, 1, 3, 4, 6, 5, 7, 0, 4, 1, 5, 2, 6, 3, 7];

function show_triangle() {
    const n = state.side;
    const code = triangle_code;
    triangle_at = triangle_at || code.call.web_room(36);
    new Float32Array(code.call.memory.buffer, triangle_at, 9).set(state.corners);
    const start = performance.now();
    const cells = code.bytes(code.call.web_triangle(triangle_at, n, state.size, state.rule), n * n * n);
    const took = performance.now() - start;
    const [set, missed, extra] = code.numbers();
    const matrix = new THREE.Matrix4();
    const lines = [];
    const used = { set: 0, missed: 0, extra: 0 };
    for (let i = 0; i < cells.length; i++) {
        const kind = ['', 'missed', 'extra', 'set'][cells[i]];
        if (!kind) {
            continue;
        }
        const x = i % n + 0.5 - n / 2;
        const y = Math.floor(i / n / n) + 0.5 - n / 2;
        const z = n / 2 - Math.floor(i / n) % n - 0.5;
        boxes[kind].setMatrixAt(used[kind]++, matrix.makeTranslation(x, y, z));
        for (const corner of BOX_EDGES) {
            lines.push(x + (corner & 1 ? 0.48 : -0.48), y + (corner & 2 ? 0.48 : -0.48), z + (corner & 4 ? 0.48 : -0.48));
        }
    }
    for (const kind of Object.keys(boxes)) {
        boxes[kind].count = used[kind];
        boxes[kind].instanceMatrix.needsUpdate = true;
    }
    edges.geometry.dispose();
    edges.geometry = new THREE.BufferGeometry().setAttribute('position', new THREE.BufferAttribute(new Float32Array(lines), 3));
    for (let k = 0; k < 3; k++) {
        const p = to_world(state.corners.subarray(3 * k, 3 * k + 3));
        handles[k].position.copy(p);
        handles[k].scale.setScalar(n * 0.019 + 0.03);
        triangle_positions.setXYZ(k, p.x, p.y, p.z);
        for (let a = 0; a < 3; a++) {
            const field = by_id(`c${k}${a}`);
            if (document.activeElement !== field) {
                field.value = shortest_float(state.corners[3 * k + a]);
            }
        }
    }
    triangle_positions.needsUpdate = true;
    triangle_shape.computeBoundingSphere();
    Object.assign(document.body.dataset, { voxels: set, missed, extra });
    show_numbers([['voxels set', count_text(set)], ['of the grid\u2019s', count_text(n ** 3)],
        ['float test errs', state.rule === 0 ? count_text(missed + extra) : '\u2013', missed + extra > 0]]);
    say(`${RULES[state.rule][0].toUpperCase()}${RULES[state.rule].slice(1)} voxels: the triangle touches ${set} of ${n ** 3}. `
        + (state.rule !== 0 ? 'The plain float test knows closed boxes only.'
            : missed + extra === 0 ? 'A plain float test agrees on all of them.'
                : `A plain float test gets ${missed + extra} wrong: it misses ${missed} and adds ${extra}.`), missed + extra > 0);
    document.body.dataset.took = took.toFixed(2);
    draw();
}

// The fewest digits that give the float back
function shortest_float(x) {
    for (let digits = 1; digits < 9; digits++) {
        if (Math.fround(Number(x.toPrecision(digits))) === x) {
            return String(Number(x.toPrecision(digits)));
        }
    }
    return x.toPrecision(9);
}

function set_coordinate(corner, axis, value) {
    const most = (state.side + 1) * state.size;
    if (Number.isFinite(value)) {
        state.corners[3 * corner + axis] = Math.min(Math.max(value, -state.size), most);
    }
}

// The next float up or down
function next_float(x, up) {
    const bits = new Int32Array(1);
    const value = new Float32Array(bits.buffer);
    value[0] = x;
    if (x === 0) {
        bits[0] = up ? 1 : -0x7fffffff;
    } else {
        bits[0] += (x > 0) === up ? 1 : -1;
    }
    return value[0];
}

const KEY_MOVES = { ArrowRight: [0, 1], ArrowLeft: [0, -1], ArrowUp: [1, 1], ArrowDown: [1, -1], PageUp: [2, 1], PageDown: [2, -1] };

// To the next of the planes i*size, each a float, or by a quarter of a voxel
function move_corner(corner, key, by_float) {
    const [axis, sign] = KEY_MOVES[key];
    const x = state.corners[3 * corner + axis];
    const step = by_id('snap').checked ? 1 : 0.25;
    const steps = Math.round(x / state.size / step) + sign;
    set_coordinate(corner, axis, by_float ? next_float(x, sign > 0) : Math.fround(steps * step * state.size));
    show_triangle();
}

function choose_corner(corner) {
    for (let k = 0; k < 3; k++) {
        by_id(`corner${k}`).setAttribute('aria-pressed', k === corner);
        handles[k].material.color.set(k === corner ? 0xffffff : CORNER_COLOURS[k]);
    }
    draw();
}

function make_corners() {
    for (let k = 0; k < 3; k++) {
        const row = document.createElement('div');
        const name = 'ABC'[k];
        row.className = 'corner';
        row.innerHTML = `<button id="corner${k}" aria-pressed="false" aria-label="Corner ${name}: arrow keys and page keys move it">${name}</button>`
            + ['x', 'y', 'z'].map((axis, a) => `<input id="c${k}${a}" inputmode="decimal" aria-label="${axis} of corner ${name}">`).join('');
        by_id('corners').append(row);
        by_id(`corner${k}`).addEventListener('focus', () => choose_corner(k));
        by_id(`corner${k}`).addEventListener('keydown', (event) => {
            if (KEY_MOVES[event.key]) {
                event.preventDefault();
                move_corner(k, event.key, event.shiftKey);
            }
        });
        for (let a = 0; a < 3; a++) {
            by_id(`c${k}${a}`).addEventListener('change', (event) => {
                set_coordinate(k, a, Number(event.target.value.trim() || NaN));
                event.target.value = shortest_float(state.corners[3 * k + a]);
                show_triangle();
            });
        }
    }
}

// ---- 5. A mesh: the faces between voxels that are set and those that are not

const mesh_material = new THREE.ShaderMaterial({
    vertexShader: `
        attribute float side;
        varying vec3 light;
        void main() {
            float face = mod(side, 8.0);
            float dark = floor(side / 8.0);
            float axis = floor(face / 2.0);
            float sign = mod(face, 2.0) * 2.0 - 1.0;
            vec3 normal = sign * vec3(axis == 0.0, axis == 1.0, axis == 2.0);
            normal = normalize(mat3(modelMatrix) * normal);
            vec4 world = modelMatrix * vec4(position, 1.0);
            float sun = max(dot(normal, normalize(vec3(-0.42, 0.74, 0.62))), 0.0);
            float sky = 0.62 + 0.38 * normal.y;
            float high = clamp(world.y / 40.0 + 0.5, 0.0, 1.0);
            vec3 clay = mix(vec3(0.66, 0.17, 0.05), vec3(0.86, 0.37, 0.13), high);
            light = clay * (0.86 * sun * vec3(1.0, 0.94, 0.84) + 0.24 * sky * vec3(0.72, 0.84, 1.0) + 0.03) * (1.0 - 0.2 * dark);
            gl_Position = projectionMatrix * viewMatrix * world;
        }`,
    fragmentShader: `
        varying vec3 light;
        void main() {
            gl_FragColor = vec4(pow(light, vec3(1.0 / 2.2)), 1.0);
        }`,
});
const mesh_view = new THREE.Mesh(new THREE.BufferGeometry(), mesh_material);
mesh_view.visible = false;
mesh_view.frustumCulled = false;
scene.add(mesh_view);

// Two triangles a face, cut so that the darker corners lie on the cut
function face_indices(corners, count) {
    const out = new Uint32Array(6 * count);
    for (let i = 0; i < count; i++) {
        const c = 16 * i;
        const turn = corners[c + 3] + corners[c + 11] > corners[c + 7] + corners[c + 15] ? 0 : 1;
        for (let k = 0; k < 6; k++) {
            out[6 * i + k] = 4 * i + ([0, 1, 2, 0, 2, 3][k] + turn) % 4;
        }
    }
    return out;
}

function show_faces() {
    const code = mesh_code;
    const count = code.call.web_faces();
    if (!count) {
        mesh_view.visible = false;
        return;
    }
    const corners = new Uint16Array(code.call.memory.buffer, code.numbers()[1], 16 * count).slice();
    const all = new THREE.InterleavedBuffer(corners, 4);
    const [nx, ny, nz] = mesh_numbers.sides;
    const scale = 40 / Math.max(nx, ny, nz);
    mesh_view.geometry.dispose();
    mesh_view.geometry = new THREE.BufferGeometry();
    mesh_view.geometry.setAttribute('position', new THREE.InterleavedBufferAttribute(all, 3, 0));
    mesh_view.geometry.setAttribute('side', new THREE.InterleavedBufferAttribute(all, 1, 3));
    mesh_view.geometry.setIndex(new THREE.BufferAttribute(face_indices(corners, count), 1));
    mesh_view.rotation.set(state.up === 'y' ? 0 : -Math.PI / 2, 0, 0);
    mesh_view.scale.setScalar(scale);
    mesh_view.position.copy(new THREE.Vector3(-nx / 2, -ny / 2, -nz / 2).multiplyScalar(scale).applyEuler(mesh_view.rotation));
    mesh_view.visible = state.mode === 'mesh';
}

function show_mesh() {
    const code = mesh_code;
    const start = performance.now();
    if (!code.call.web_fill(state.resolution, state.rule, state.solid ? 1 : 0)) {
        say(code.text(code.call.web_error()), true);
        return;
    }
    const took = performance.now() - start;
    const [voxels, nx, ny, nz] = code.numbers();
    mesh_numbers.sides = [nx, ny, nz];
    Object.assign(document.body.dataset, { voxels, missed: 0, extra: 0, took: took.toFixed(2) });
    show_faces();
    show_numbers([['triangles', count_text(mesh_numbers.triangles)], ['voxels set', count_text(voxels)], ['filled in', `${took < 10 ? took.toFixed(1) : took.toFixed(0)} ms`]]);
    say(`${state.name}: the ${state.solid ? 'solid, by voxel centres,' : `surface, ${RULES[state.rule]} voxels,`} sets ${count_text(voxels)} voxels `
        + `in a grid of ${nx} \u00d7 ${ny} \u00d7 ${nz}.${mesh_numbers.exact ? ' Some coordinates are no floats: computed in double.' : ''}${mesh_numbers.warning}`);
    draw();
}

async function read_mesh(name, bytes) {
    const code = await make_instance(module);
    const text = new TextEncoder().encode(`${name}\0`);
    const name_at = code.put(text);
    const at = bytes ? code.put(bytes) : 0;
    let ok = false;
    try {
        ok = bytes && !at ? false : code.call.web_read(name_at, at, bytes ? bytes.length : 0);
    } catch (error) {
        say(`${name}: ${error.message}`, true);
        return;
    }
    if (!ok) {
        say(bytes && !at ? `${name}: too large` : code.text(code.call.web_error()), true);
        document.body.dataset.failed = name;
        return;
    }
    const [triangles, vertices, exact] = code.numbers();
    const format = code.text(code.call.web_format());
    const warning = code.text(code.call.web_error());
    mesh_code = code;
    mesh_numbers = { triangles, vertices, exact, warning: warning ? ` ${warning}` : '', sides: [1, 1, 1] };
    state.name = name;
    state.up = /PLY|OBJ|glTF/.test(format) ? 'y' : 'z';
    document.body.dataset.mesh = name;
    set_mode('mesh');
}

function save(kind) {
    const names = ['vox', 'npy', 'obj'];
    const at = mesh_code.call.web_save(kind, state.up.charCodeAt(0));
    if (!at) {
        say(mesh_code.text(mesh_code.call.web_error()), true);
        return;
    }
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([mesh_code.bytes(at, mesh_code.numbers()[0]).slice()]));
    link.download = `${state.name.replace(/\.[^.]*$/, '')}.${names[kind]}`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

// ---- 6. Mouse, keys, files

function set_mode(mode) {
    state.mode = mode;
    document.querySelector(`input[name=mode][value=${mode}]`).checked = true;
    by_id('triangle').hidden = mode !== 'triangle';
    by_id('mesh').hidden = mode !== 'mesh';
    triangle_view.visible = mode === 'triangle';
    mesh_view.visible = false;
    document.body.dataset.mode = mode;
    frame();
    if (mode === 'triangle') {
        show_triangle();
    } else if (mesh_code) {
        show_mesh();
    } else {
        read_mesh('teapot', null);
    }
}

function frame() {
    const narrow = Math.min(1, (canvas.clientWidth - (canvas.clientWidth > 760 ? 372 : 0)) / canvas.clientHeight);
    orbit.far = (state.mode === 'triangle' ? 2.55 * state.side : 98) / Math.max(narrow, 0.35);
}

function pointer_ray(event) {
    const box = canvas.getBoundingClientRect();
    const ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2((event.clientX - box.left) / box.width * 2 - 1, 1 - (event.clientY - box.top) / box.height * 2), camera);
    return ray;
}

// The corner under the pointer, within twice its radius; -1 if there is none
function corner_at(event) {
    let best = -1;
    let nearest = Infinity;
    const { ray } = pointer_ray(event);
    for (let k = 0; k < 3 && state.mode === 'triangle'; k++) {
        const away = ray.distanceToPoint(handles[k].position) / (2 * handles[k].scale.x);
        if (away < 1 && away < nearest) {
            nearest = away;
            best = k;
        }
    }
    return best;
}

let drag = null;
canvas.addEventListener('pointerdown', (event) => {
    const corner = corner_at(event);
    const plane = new THREE.Plane();
    if (corner >= 0) {
        plane.setFromNormalAndCoplanarPoint(camera.getWorldDirection(new THREE.Vector3()), handles[corner].position);
        choose_corner(corner);
    }
    drag = { corner, plane, x: event.clientX, y: event.clientY };
    canvas.setPointerCapture(event.pointerId);
});
canvas.addEventListener('pointermove', (event) => {
    if (!drag) {
        canvas.style.cursor = corner_at(event) >= 0 ? 'grab' : 'default';
        return;
    }
    if (drag.corner >= 0) {
        const point = pointer_ray(event).ray.intersectPlane(drag.plane, new THREE.Vector3());
        if (point) {
            to_corner(point).forEach((x, a) => {
                const snapped = by_id('snap').checked ? Math.fround(Math.round(x / state.size) * state.size) : x;
                set_coordinate(drag.corner, a, snapped);
            });
            show_triangle();
        }
        return;
    }
    orbit.yaw -= (event.clientX - drag.x) * 0.007;
    orbit.pitch = Math.min(Math.max(orbit.pitch + (event.clientY - drag.y) * 0.007, -1.5), 1.5);
    drag.x = event.clientX;
    drag.y = event.clientY;
    draw();
});
canvas.addEventListener('pointerup', () => { drag = null; });
canvas.addEventListener('pointercancel', () => { drag = null; });
canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    orbit.far = Math.min(Math.max(orbit.far * Math.exp(event.deltaY * 0.001), 3), 600);
    draw();
}, { passive: false });
canvas.addEventListener('keydown', (event) => {
    const turn = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[event.key];
    const zoom = { '+': 0.9, '=': 0.9, '-': 1.1 }[event.key];
    if (turn || zoom) {
        event.preventDefault();
        orbit.yaw += turn ? turn[0] : 0;
        orbit.pitch = Math.min(Math.max(orbit.pitch + (turn ? turn[1] : 0), -1.5), 1.5);
        orbit.far *= zoom || 1;
        draw();
    }
});

function show() {
    (state.mode === 'triangle' ? show_triangle : show_mesh)();
}

document.querySelectorAll('input[name=mode]').forEach((input) => input.addEventListener('change', () => set_mode(input.value)));
document.querySelectorAll('input[name=rule]').forEach((input) => input.addEventListener('change', () => {
    state.rule = Number(input.value);
    show();
}));
document.querySelectorAll('input[name=fill]').forEach((input) => input.addEventListener('change', () => {
    state.solid = input.value === '1';
    show();
}));
by_id('side').addEventListener('input', (event) => {
    const before = state.side;
    state.side = Number(event.target.value);
    by_id('side_out').textContent = event.target.value;
    state.corners = state.corners.map((x) => Math.fround(Math.round(x / state.size * state.side / before) * state.size));
    draw_cage();
    frame();
    show_triangle();
});
by_id('resolution').addEventListener('input', (event) => {
    state.resolution = Number(event.target.value);
    by_id('resolution_out').textContent = event.target.value;
    show_mesh();
});
by_id('teapot').addEventListener('click', () => read_mesh('teapot', null));
by_id('save_vox').addEventListener('click', () => save(0));
by_id('save_npy').addEventListener('click', () => save(1));
by_id('save_obj').addEventListener('click', () => save(2));

async function take_file(file) {
    if (file) {
        await read_mesh(file.name, new Uint8Array(await file.arrayBuffer()));
    }
}
by_id('file').addEventListener('change', (event) => take_file(event.target.files[0]));
addEventListener('dragover', (event) => {
    event.preventDefault();
    document.body.classList.add('dragging');
});
addEventListener('dragleave', (event) => {
    if (!event.relatedTarget) {
        document.body.classList.remove('dragging');
    }
});
addEventListener('drop', (event) => {
    event.preventDefault();
    document.body.classList.remove('dragging');
    take_file(event.dataTransfer.files[0]);
});
addEventListener('resize', () => {
    frame();
    draw();
});

// Where corner k is on the screen, for tests
function corner_on_screen(k) {
    place_camera();
    const p = handles[k].position.clone().project(camera);
    return [(p.x + 1) / 2 * canvas.clientWidth, (1 - p.y) / 2 * canvas.clientHeight];
}

(async () => {
    module = await WebAssembly.compile(Uint8Array.from(atob(TRIBOX_WASM), (c) => c.charCodeAt(0)));
    triangle_code = await make_instance(module);
    make_corners();
    draw_cage();
    set_mode('triangle');
})();
