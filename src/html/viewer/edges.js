// Wireframe of polygons, drawn by the surface's own shader: lines stay one pixel wide and hidden where the surface is.
import { Float32BufferAttribute } from 'three';

export const wire = { value: 0 };  // 1 draws edges

const key = (a, b) => (a < b ? `${a} ${b}` : `${b} ${a}`);

// Per corner its barycentric coordinates; a coordinate that stays 1 all over the triangle hides the opposite edge. An
// edge between two triangles of one polygon is inside of it.
export function add_edges(geometry, polygons, corners) {
  const coordinates = new Float32Array(3 * corners.length);
  const inner = new Set();
  let begin = 0;
  const close = (end) => {
    const seen = new Set();
    for (let t = begin; end - begin > 1 && t < end; ++t)
      for (let k = 0; k < 3; ++k) {
        const edge = key(corners[3 * t + k], corners[3 * t + (k + 1) % 3]);
        if (seen.has(edge)) inner.add(`${polygons[t]} ${edge}`);
        seen.add(edge);
      }
    begin = end;
  };
  for (let t = 1; t <= polygons.length; ++t)
    if (t === polygons.length || polygons[t] !== polygons[begin]) close(t);
  for (let t = 0; t < polygons.length; ++t)
    for (let k = 0; k < 3; ++k) {
      coordinates[9 * t + 3 * k + k] = 1;
      const edge = key(corners[3 * t + (k + 1) % 3], corners[3 * t + (k + 2) % 3]);
      if (inner.has(`${polygons[t]} ${edge}`)) for (let c = 0; c < 3; ++c) coordinates[9 * t + 3 * c + k] = 1;
    }
  geometry.setAttribute('edge', new Float32BufferAttribute(coordinates, 3));
}

// The same material with edges over it where `wire` says so.
export function with_edges(material) {
  material.onBeforeCompile = (shader) => {
    shader.uniforms.wire = wire;
    shader.vertexShader = shader.vertexShader
      .replace('void main() {', 'attribute vec3 edge;\nvarying vec3 vEdge;\nvoid main() {\n  vEdge = edge;');
    shader.fragmentShader = shader.fragmentShader
      .replace('void main() {', 'varying vec3 vEdge;\nuniform float wire;\nvoid main() {')
      .replace('#include <dithering_fragment>', `#include <dithering_fragment>
        vec3 reach = vEdge / max(fwidth(vEdge), vec3(1e-6));
        float line = 1.0 - smoothstep(0.15, 0.95, min(reach.x, min(reach.y, reach.z)));
        float bright = dot(gl_FragColor.rgb, vec3(0.3, 0.6, 0.1));
        gl_FragColor.rgb = mix(gl_FragColor.rgb, vec3(bright > 0.35 ? 0.05 : 0.85), 0.5 * wire * line);`);
  };
  material.customProgramCacheKey = () => 'edges';
  return material;
}
