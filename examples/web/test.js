// Drives the page in a real Chromium, from its folder: node test.js FOLDER VOXELIZE CHROMIUM
// Every count of voxels, and every file saved, is that of the native program. Pictures stay in the folder.
'use strict';
const { execFileSync } = require('child_process');
const fs = require('fs');
const path = require('path');
const { chromium } = require('playwright-core');

const [folder, voxelize, browser_path] = process.argv.slice(2);
let passed = 0;
let failed = 0;

function check(ok, what) {
    if (ok) {
        passed++;
    } else {
        failed++;
        console.log(`FAILED ${what}`);
    }
}

function same(got, want, what) {
    check(JSON.stringify(got) === JSON.stringify(want), `${what}: ${JSON.stringify(got)} instead of ${JSON.stringify(want)}`);
}

// The native program's count
function native(...words) {
    const out = execFileSync(voxelize, words, { encoding: 'utf8' });
    return Number(/(?:surface|solid) +(\d+) voxels/.exec(out)[1]);
}

const RULE_OPTIONS = { 0: '--closed', 1: '--half-open', 2: '--open', 4: '--thin' };

// The page's triangle by the native program: the whole space, of which the page shows a part; so corners stay inside
function native_triangle(corners, rule) {
    const file = path.join(folder, 'test_triangle.obj');
    const v = (k) => `v ${[0, 1, 2].map((a) => corners[3 * k + a].toPrecision(17)).join(' ')}\n`;
    fs.writeFileSync(file, `${v(0)}${v(1)}${v(2)}f 1 2 3\n`);
    return native(file, '--size', Math.fround(0.1).toPrecision(17), RULE_OPTIONS[rule]);
}

(async () => {
    const browser = await chromium.launch({ executablePath: browser_path,
        args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'] });
    const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
    const errors = [];
    page.on('pageerror', (error) => errors.push(String(error)));
    page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
    const data = () => page.evaluate(() => ({ ...document.body.dataset }));
    const corners = () => page.evaluate(() => [...state.corners]);
    const said = () => page.locator('#said').textContent();
    const picture = (name) => page.screenshot({ path: path.join(folder, `test_${name}.png`) });
    const agrees = async (rule, what) => same(Number((await data()).voxels), native_triangle(await corners(), rule), what);

    await page.goto(`file://${path.resolve(folder, 'index.html')}`);
    await page.waitForFunction(() => document.body.dataset.voxels !== undefined);
    await agrees(0, 'the first triangle');
    check((await said()).includes(`touches ${(await data()).voxels} of 1000`), 'what it says');
    check(await page.locator('#said').getAttribute('aria-live') === 'polite', 'it is said aloud');
    await picture('triangle');

    // a drag moves the corner to a grid plane, and the answer with it
    const before = await corners();
    const [x, y] = await page.evaluate(() => corner_on_screen(1));
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x - 60, y + 30, { steps: 4 });
    await page.mouse.up();
    const after = await corners();
    check(after.slice(3, 6).some((c, a) => c !== before[3 + a]), 'a drag moves its corner');
    same([after.slice(0, 3), after.slice(6)], [before.slice(0, 3), before.slice(6)], 'a drag moves no other corner');
    check(after.slice(3, 6).every((c) => c === Math.fround(Math.round(c / Math.fround(0.1)) * Math.fround(0.1))), 'it snaps to the grid');
    await agrees(0, 'after the drag');

    // a drag beside the corners turns the view and changes no answer
    await page.mouse.move(120, 700);
    await page.mouse.down();
    await page.mouse.move(180, 690, { steps: 3 });
    await page.mouse.up();
    same(await corners(), after, 'turning the view');

    // keys: a corner by Tab and arrows, to the next float with Shift; rules by arrows
    await page.locator('#corner2').focus();
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('PageDown');
    await agrees(0, 'after keys');
    const third = (await corners())[6];
    await page.keyboard.press('Shift+ArrowRight');
    check((await corners())[6] > third && (await corners())[6] < third + 1e-7, 'Shift moves to the next float');
    await agrees(0, 'one float further');
    await page.keyboard.press('Shift+ArrowLeft');
    for (const [rule, keys] of [[0, 0], [1, 1], [2, 1], [4, 1]]) {
        await page.locator('input[name=rule]:checked').focus();
        for (let i = 0; i < keys; i++) {
            await page.keyboard.press('ArrowRight');
        }
        same(await page.locator('input[name=rule]:checked').getAttribute('value'), String(rule), 'rules by keys');
        await agrees(rule, `rule ${rule}`);
    }
    await picture('thin');
    await page.locator('input[name=rule][value="0"]').check({ force: true });

    // numbers typed; a triangle on the grid's planes, on which a plain float test errs
    for (const [k, row] of [['0.1', '0.1', '0.3'], ['0.7', '0.2', '0.3'], ['0.3', '0.9', '0.3']].entries()) {
        for (const [a, text] of row.entries()) {
            await page.locator(`#c${k}${a}`).fill(text);
            await page.locator(`#c${k}${a}`).press('Enter');
        }
    }
    same(await corners(), [0.1, 0.1, 0.3, 0.7, 0.2, 0.3, 0.3, 0.9, 0.3].map(Math.fround), 'numbers typed');
    await agrees(0, 'a triangle in a plane of the grid');
    const flat = await data();
    check(Number(flat.missed) + Number(flat.extra) > 0, 'a plain float test errs there');
    check((await said()).includes('A plain float test gets'), 'and the page says so');
    await picture('wrong');

    // meshes: the teapot, then the bunny, dropped and opened
    await page.locator('input[name=mode][value=mesh]').check({ force: true });
    await page.waitForFunction(() => document.body.dataset.mesh === 'teapot');
    await page.waitForFunction(() => document.body.dataset.mode === 'mesh' && Number(document.body.dataset.voxels) > 2000);
    same(Number((await data()).voxels), native('teapot-closed', '64'), 'the teapot');
    await picture('teapot');
    const bunny = path.join(folder, 'bunny.ply');
    const drop = async (name, bytes) => {
        const moved = await page.evaluateHandle(([file_name, base64]) => {
            const transfer = new DataTransfer();
            transfer.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], file_name));
            return transfer;
        }, [name, bytes.toString('base64')]);
        await page.dispatchEvent('#view', 'drop', { dataTransfer: moved });
    };
    await drop('bunny.ply', fs.readFileSync(bunny));
    await page.waitForFunction(() => document.body.dataset.mesh === 'bunny.ply');
    const save = async (button) => {
        const [download] = await Promise.all([page.waitForEvent('download'), page.locator(button).click()]);
        return fs.readFileSync(await download.path());
    };
    for (const [resolution, solid] of [[64, 0], [64, 1], [160, 1], [160, 0]]) {
        await page.locator(`input[name=fill][value="${solid}"]`).check({ force: true });
        await page.locator('#resolution').evaluate((input, n) => {
            input.value = n;
            input.dispatchEvent(new Event('input'));
        }, resolution);
        const words = [bunny, String(resolution), ...(solid ? ['--solid'] : [])];
        same(Number((await data()).voxels), native(...words), `the bunny at ${resolution}, ${solid ? 'solid' : 'surface'}`);
        for (const [button, ending] of [['#save_vox', 'vox'], ['#save_npy', 'npy'], ['#save_obj', 'obj']]) {
            const file = path.join(folder, `test_native.${ending}`);
            execFileSync(voxelize, [...words, '-o', file], { stdio: 'ignore' });
            check((await save(button)).equals(fs.readFileSync(file)), `the same .${ending} as the native program, at ${resolution}`);
        }
    }
    for (const rule of [1, 2, 4]) {
        await page.locator(`input[name=rule][value="${rule}"]`).check({ force: true });
        same(Number((await data()).voxels), native(bunny, '160', RULE_OPTIONS[rule]), `the bunny, rule ${rule}`);
    }
    await picture('bunny');

    // every small format, decimals that are no floats, and a file that is none
    const files = {
        'a.obj': 'v 5411932.7 0 0\nv 5411933.7 0.1 0\nv 5411932.7 1 0.25\nf 1 2 3\n',
        'a.off': 'OFF\n4 1 4\n0 0 .5\n8 8 .5\n0 3 .5\n-8 8 .5\n4 1 2 3 0\n',
        'a.stl': 'solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1e-1 0 0.3\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n',
        'a.ply': 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n'
            + 'property list uchar int vertex_indices\nend_header\n0 0 0\n1.00000005960464477539063 0 0\n0 1.1 .7\n3 0 1 2\n',
    };
    await page.locator('input[name=rule][value="0"]').check({ force: true });
    for (const [name, text] of Object.entries(files)) {
        fs.writeFileSync(path.join(folder, `test_${name}`), text);
        await page.locator('#file').setInputFiles(path.join(folder, `test_${name}`));
        await page.waitForFunction((want) => document.body.dataset.mesh === want, `test_${name}`);
        same(Number((await data()).voxels), native(path.join(folder, `test_${name}`), '160'), name);
    }
    check((await page.evaluate(() => c_number(1234567, 'g', 6) + c_number(0.1, 'g', 17) + c_number(1e-7, 'g', 3) + c_number(2.5, 'f', 3)))
        === '1.23457e+060.100000000000000011e-072.500', 'numbers printed as C does');
    await drop('a.gz', Buffer.from([31, 139, 8, 0]));
    await page.waitForFunction(() => document.body.dataset.failed === 'a.gz');
    check((await said()).includes('this is a gzip file'), 'a file that is no mesh is named');
    await drop('bunny.ply', fs.readFileSync(bunny));
    await page.waitForFunction(() => document.body.dataset.mesh === 'bunny.ply');
    same(Number((await data()).voxels), native(bunny, '160'), 'the bunny once more');

    await page.setViewportSize({ width: 420, height: 860 });
    await page.waitForTimeout(300);
    await picture('narrow');
    same(errors, [], 'errors in the console');
    await browser.close();
    console.log(`${passed} passed, ${failed} failed`);
    process.exit(failed ? 1 : 0);
})().catch((error) => {
    console.log(error);
    console.log(`${passed} passed, ${failed + 1} failed`);
    process.exit(1);
});
