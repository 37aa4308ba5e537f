// node bench/simd.js WITHOUT.wasm WITH.wasm: nanoseconds of each work, the best of 15 runs of each, in turn. See simd.c.
const fs = require('fs');
const kinds = {
  0: ['overlap', 512], 1: ['tri_test', 512], 2: ['tri_init and a test', 512], 3: ['tri_octants', 512],
  4: ['grid_spans, 4^3', 512], 5: ['segment_box', 512], 6: ['ray_box', 512], 7: ['sphere_triangle', 512], 8: ['gap', 512],
  10: ['grid_fill, a triangle', 4096], 11: ['fill_solid, a triangle', 4096], 12: ['mesh_query, a triangle', 4096],
};
const modules = process.argv.slice(2).map((name) => {
  const e = new WebAssembly.Instance(new WebAssembly.Module(fs.readFileSync(name))).exports;
  e.prepare();
  return e;
});
for (const [kind, [name, count]] of Object.entries(kinds)) {
  const times = kind === '11' ? 1 : kind >= 10 ? 4 : 40;
  const best = modules.map(() => Infinity);
  const sums = modules.map((m) => m.work(+kind, times));
  if (new Set(sums).size !== 1) {
    throw new Error(`${name}: different answers: ${sums}`);
  }
  for (let run = 0; run < 15; run++) {
    modules.forEach((m, i) => {
      const start = process.hrtime.bigint();
      m.work(+kind, times);
      best[i] = Math.min(best[i], Number(process.hrtime.bigint() - start) / times / count);
    });
  }
  console.log(`${name.padEnd(24)} ${best.map((ns) => ns.toFixed(1).padStart(9)).join(' ')}  ratio ${(best[1] / best[0]).toFixed(2)}`);
}
