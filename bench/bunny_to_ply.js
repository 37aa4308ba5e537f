/* bunny_to_ply.js - writes the mesh of the npm package `bunny` as an ASCII PLY file: node bunny_to_ply.js index.js */
const bunny = require(require('path').resolve(process.argv[2]));
const lines = [
    'ply', 'format ascii 1.0',
    `element vertex ${bunny.positions.length}`, 'property float x', 'property float y', 'property float z',
    `element face ${bunny.cells.length}`, 'property list uchar int vertex_indices', 'end_header',
    ...bunny.positions.map(p => p.join(' ')),
    ...bunny.cells.map(c => '3 ' + c.join(' ')),
];
console.log(lines.join('\n'));
