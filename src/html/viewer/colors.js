// What the colours of the view mean. Colours of categories: Okabe and Ito's, told apart by nearly all eyes.
import { Color } from 'three';

export const kSourceColors = ['#4e8fd0', '#e69f00', '#38a383', '#cc79a7', '#8a78c9', '#d55e00', '#7fb8e0', '#b5a642'];
export const kNewColor = '#f2e94e';
const kUnknown = '#8d9299';

export const source_color = (source) => (source < 0 ? kNewColor : kSourceColors[source % kSourceColors.length]);

// Runs [code, count] as one code a triangle.
function unpacked(runs) {
  const codes = [];
  for (const [code, count] of runs) for (let i = 0; i < count; ++i) codes.push(code);
  return codes;
}

// By the input that each face comes from.
export function paint_sources(model, view) {
  for (const part of model.parts) {
    const codes = unpacked(view.primitives[part.place] ?? []);
    part.paint((corner, color) => color.set(source_color(codes[Math.floor(corner / 3)] ?? -1)));
  }
}

// A hue for each joint, neighbours far apart (golden angle).
export const joint_color = (joint, color = new Color()) =>
  color.setHSL((joint * 0.38196601) % 1, 0.55, 0.5 + 0.12 * ((joint * 7) % 3 - 1));

// By the joint with the largest weight.
export function paint_dominant(model) {
  for (const part of model.parts)
    part.paint((corner, color) => {
      let best = [-1, 0];
      for (const row of part.influences(corner)) if (row[1] > best[1]) best = row;
      if (best[0] < 0) color.set(kUnknown);
      else joint_color(best[0], color);
    });
}

// Dark blue over green to yellow (viridis, five stops); `value` in [0, 1].
const kHeat = ['#3b2a63', '#3a5c8c', '#22908b', '#63c74e', '#fde725'].map((c) => new Color(c));
export function heat(value, color) {
  const at = Math.min(Math.max(value, 0), 1) * (kHeat.length - 1);
  const i = Math.min(Math.floor(at), kHeat.length - 2);
  return color.copy(kHeat[i]).lerp(kHeat[i + 1], at - i);
}

// The weight of one joint.
export function paint_weight(model, joint) {
  for (const part of model.parts)
    part.paint((corner, color) => {
      const row = part.influences(corner).find(([j]) => j === joint);
      heat(row ? row[1] : 0, color);
    });
}

// Values in [0, 1] per vertex of the file (NaN: unknown), one list a primitive.
export function paint_values(model, values) {
  for (const part of model.parts) {
    const of_part = values[part.place] ?? [];
    part.paint((corner, color) => {
      const value = of_part[part.vertex_of_corner[corner]];
      if (value === undefined || Number.isNaN(value)) color.set('#d0488f');
      else heat(value, color);
    });
  }
}
