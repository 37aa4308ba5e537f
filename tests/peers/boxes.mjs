// npm's box tests on the same cases: node boxes.mjs FILE, in a folder where three, three-mesh-bvh and
// @dimforge/rapier3d-compat are installed.
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';

const require = createRequire(path.join(process.cwd(), 'x.js'));
const version = (name) => JSON.parse(fs.readFileSync(path.join('node_modules', name, 'package.json'), 'utf8')).version;
const CLASSES = 9;
const bytes = fs.readFileSync(process.argv[2]);
const cases = new Float64Array(bytes.buffer, bytes.byteOffset, bytes.length / 8);

function row(name, test, floats) {
    const asked = new Array(CLASSES).fill(0);
    const missed = new Array(CLASSES).fill(0);
    const invented = new Array(CLASSES).fill(0);
    for (let i = 0; i < cases.length; i += 17) {
        const k = cases[i];
        if (floats && k === 8) {
            continue;
        }
        const answer = test(cases.subarray(i + 1, i + 16));
        asked[k] += 1;
        missed[k] += !answer && cases[i + 16] === 1 ? 1 : 0;
        invented[k] += answer && cases[i + 16] === 0 ? 1 : 0;
    }
    const per = (n, k) => Math.round(1e6 * n / asked[k]);
    console.log(`| ${name} | ${asked.map((n, k) => n ? `${per(missed[k], k)} + ${per(invented[k], k)}` : '-').join(' | ')} |`);
}

const three = require('three');
const v = [0, 1, 2, 3, 4].map(() => new three.Vector3());
const set = (c) => v.forEach((p, i) => p.set(c[3 * i], c[3 * i + 1], c[3 * i + 2]));
row(`three ${version('three')}, Box3.intersectsTriangle`, (c) => {
    set(c);
    return new three.Box3(v[3], v[4]).intersectsTriangle(new three.Triangle(v[0], v[1], v[2]));
});
const bvh = require('three-mesh-bvh');
row(`three-mesh-bvh ${version('three-mesh-bvh')}, OrientedBox.intersectsTriangle`, (c) => {
    set(c);
    const box = new bvh.OrientedBox(v[3], v[4]);
    box.update();
    return box.intersectsTriangle(new three.Triangle(v[0], v[1], v[2]));
});
const rapier = require('@dimforge/rapier3d-compat');
await rapier.init();
row(`@dimforge/rapier3d-compat ${version('@dimforge/rapier3d-compat')}, Shape.intersectsShape of Cuboid, Triangle`, (c) => {
    const at = (i) => ({ x: c[i], y: c[i + 1], z: c[i + 2] });
    const middle = { x: (c[9] + c[12]) / 2, y: (c[10] + c[13]) / 2, z: (c[11] + c[14]) / 2 };
    const still = { x: 0, y: 0, z: 0, w: 1 };
    const box = new rapier.Cuboid((c[12] - c[9]) / 2, (c[13] - c[10]) / 2, (c[14] - c[11]) / 2);
    return box.intersectsShape(middle, still, new rapier.Triangle(at(0), at(3), at(6)), { x: 0, y: 0, z: 0 }, still);
}, true);
