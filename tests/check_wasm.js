// Runs the golden program built for WebAssembly without a library: node tests/check_wasm.js golden.wasm
'use strict';
const bytes = require('fs').readFileSync(process.argv[2]);
const golden = new WebAssembly.Instance(new WebAssembly.Module(bytes), {}).exports;
const hex = (high, low) => [high, low].map((w) => (w >>> 0).toString(16).padStart(8, '0')).join('');
const got = hex(golden.golden_hash_high(), golden.golden_hash_low());
const want = hex(golden.golden_expected_high(), golden.golden_expected_low());
const wrong = golden.golden_wrong();
const ok = got === want && wrong === 0;
console.log(`golden wasm32   ${got} ${ok ? 'ok' : 'DIFFERS'}`);
if (wrong !== 0) {
    console.log(`    first wrong answer: golden_table[${wrong - 1}]`);
}
process.exit(ok ? 0 : 1);
