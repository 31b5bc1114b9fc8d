#pragma once

#include "report/report.h"
#include "report/timings.h"

/// The names, units and meanings of everything a report holds, once for writing JSON and for its schema. A
/// visitor `f` is called as f(name, member, unit, meaning) in the order of the file.
namespace skinforge {

template <class F>
void describe(const Issue& i, F& f) {
  f("code", i.code, "text", "Stable code of the issue; src/report/issues.md lists all of them");
  f("severity", i.severity, "text", "note: settled, nothing lost; warning: worth a look");
  f("place", i.place, "text", "Where it was met: file and object, operation or clip");
  f("message", i.message, "text", "One sentence with the values");
}

template <class F>
void describe(const Distribution& d, F& f) {
  f("count", d.count, "count", "Number of values");
  f("min", d.min, "as the property", "Least value");
  f("mean", d.mean, "as the property", "Arithmetic mean");
  f("p05", d.p05, "as the property", "5th percentile, linear between ranks");
  f("p25", d.p25, "as the property", "25th percentile");
  f("p50", d.p50, "as the property", "Median");
  f("p75", d.p75, "as the property", "75th percentile");
  f("p95", d.p95, "as the property", "95th percentile");
  f("max", d.max, "as the property", "Greatest value");
}

template <class F>
void describe(const ToolReport& t, F& f) {
  f("name", t.name, "text", "The tool that wrote this report");
  f("version", t.version, "text", "Its version");
}

template <class F>
void describe(const RecipeReport& r, F& f) {
  f("name", r.name, "text", "Name of the recipe");
  f("sha256", r.sha256, "hex digits",
    "Digest of what the recipe asks for; paths, comments and key order do not change it");
}

template <class F>
void describe(const FileReport& o, F& f) {
  f("name", o.name, "text", "File name: of an input without folders, of an output relative to its folder");
  f("bytes", o.bytes, "bytes", "Its size");
  f("sha256", o.sha256, "hex digits", "Digest of its bytes");
}

template <class F>
void describe(const InputReport& i, F& f) {
  f("name", i.name, "text", "Name of the input in the recipe");
  f("file", i.file, "text", "Name of its file or recipe, without folders");
  f("format", i.format, "text", "File format");
  f("files", i.files, "list",
    "All files it was read from: the model, what it refers to, files with further clips; of a recipe, those "
    "of "
    "its inputs");
  f("vertices", i.vertices, "count", "Vertices after welding by bind position");
  f("faces", i.faces, "count", "Polygons");
  f("quads", i.quads, "count", "Polygons with four corners");
  f("joints", i.joints, "count", "Joints of its one tree");
  f("clips", i.clips, "count", "Animation clips");
  f("materials", i.materials, "count", "Materials");
  f("images", i.images, "count", "Images");
  f("morph_targets", i.morph_targets, "count", "Morph targets");
  f("bind_size", i.bind_size, "m", "Width, height and depth of the bind pose's bounding box");
  f("repairs", i.repairs, "list", "What was odd in the file and how it was settled");
}

template <class F>
void describe(const OperationReport& o, F& f) {
  f("kind", o.kind, "text", "replace, attach, remove or detach");
  f("at", o.at, "text", "Joints of the character at which it was carried out");
  f("input", o.input, "text", "Input that the new part comes from; empty when there is none");
  f("joint", o.joint, "text", "Top joint of the new part in that input; empty when there is none");
  f("fused_joint", o.fused_joint, "text",
    "Joint of the result at the top of the new part; empty when there is none");
  f("scale", o.scale, "ratio", "Placement used: uniform scale of the input");
  f("rotation_xyzw", o.rotation_xyzw, "quaternion", "Placement used: rotation of the input, x y z w");
  f("translation", o.translation, "m", "Placement used: p -> scale * rotation * p + translation");
  f("bend_deg", o.bend_deg, "deg",
    "Angle between the part as the recipe places it and the line of its host; 0 = it goes on where the host "
    "ends");
  f("turned_deg", o.turned_deg, "deg", "Turned back by, because the surfaces would not join as placed");
}

template <class F>
void describe(const LedgerEntry& e, F& f) {
  f("kind", e.kind, "text", "What sort of thing it is");
  f("input", e.input, "text", "Input that brought it");
  f("item", e.item, "text", "Its name there");
  f("state", e.state, "text",
    "kept: in the result as it was; changed: in it, but different; dropped: not in it");
  f("results", e.results, "text", "Its names in the result");
  f("reason", e.reason, "text", "Why it changed or was dropped; empty when kept");
}

template <class F>
void describe(const MappedJointReport& m, F& f) {
  f("joint", m.joint, "text", "Joint of the source's input");
  f("image", m.image, "text", "Joint of the result that stands for it (SkinMixer Sec. 5)");
  f("confidence", m.confidence, "ratio", "How sure that is, from 0 to 1");
}

template <class F>
void describe(const JointMapReport& m, F& f) {
  f("source", m.source, "index",
    "Placed use of an input: 0 is the base, then one for each replace or attach");
  f("input", m.input, "text", "Input that the source is a use of");
  f("joints", m.joints, "list", "Every joint of the input with its image in the result");
}

template <class F>
void describe(const ResultJointReport& j, F& f) {
  f("joint", j.joint, "text", "Joint of the result, parents before children");
  f("source", j.source, "index", "Source that it comes from");
  f("input", j.input, "text", "Input of that source");
  f("source_joint", j.source_joint, "text", "Its name there");
}

template <class F>
void describe(const ColorStepReport& c, F& f) {
  f("edges", c.edges, "count", "Edges between kept and new faces");
  f("mean", c.mean, "1/255", "Mean step of the largest channel (sRGB)");
  f("p95", c.p95, "1/255", "95th percentile");
  f("max", c.max, "1/255", "Largest step");
}

template <class F>
void describe(const SymmetryReport& s, F& f) {
  f("image_operation", s.image_operation, "index",
    "Operation whose junction is its mirror image, itself or another; 0 = it is not meant to be symmetric");
  f("reason", s.reason, "text", "Why it is not symmetric; empty when it is");
  f("plane_normal", s.plane_normal, "ratio", "Unit normal of the base's plane of symmetry; 0 0 0 = none");
  f("plane_offset", s.plane_offset, "m", "Distance of that plane from the origin along the normal");
  f("matched", s.matched, "ratio", "Share of the base's vertices that have a mirror image");
  f("faces_symmetric", s.faces_symmetric, "yes/no", "Whether every new face and vertex has a mirror image");
  f("mean_deviation", s.mean_deviation, "edges",
    "New vertices from the images of their images, in mean edges; null where not symmetric");
  f("max_deviation", s.max_deviation, "edges", "The farthest of them");
  f("border_deviation", s.border_deviation, "edges",
    "The same of the border vertices, which are the inputs' own, the farthest");
}

template <class F>
void describe(const JunctionReport& j, F& f) {
  f("operation", j.operation, "index", "Operation that made this junction, counted from 1");
  f("rung", j.rung, "text", "Method that made its surface");
  f("reason", j.reason, "text", "Why that method and no finer one; empty when it was the first choice");
  f("voxel", j.voxel, "m", "Edge of the voxels of its distance field");
  f("components", j.components, "count", "Connected pieces of its surface");
  f("border_loops", j.border_loops, "vertices",
    "Length of each closed border between kept surface and junction");
  f("faces", j.faces, "count", "Faces made new");
  f("quads", j.quads, "count", "Of them with four corners");
  f("triangles", j.triangles, "count", "Of them with three corners");
  f("boundary_edges", j.boundary_edges, "count",
    "Open edges at the junction that no input had; 0 = watertight");
  f("non_manifold_edges", j.non_manifold_edges, "count", "Edges of more than two faces that no input had");
  f("degenerate_faces", j.degenerate_faces, "count", "Faces of nearly no area or with a doubled vertex");
  f("folded_faces", j.folded_faces, "count",
    "Faces turned against the surface below them; null = not measured");
  f("self_intersections", j.self_intersections, "count",
    "Pairs of faces, one of them new, that cut each other; null = not measured");
  f("irregular_vertices", j.irregular_vertices, "count",
    "Vertices whose valence is not 4; null for triangle junctions");
  f("border_continuation", j.border_continuation, "ratio",
    "Share of border vertices with regular valence; null for triangle junctions");
  f("scaled_jacobian", j.scaled_jacobian, "ratio",
    "Least scaled Jacobian of each quad, 1 = square; null without quads");
  f("deviation", j.deviation, "voxels",
    "Distance of the surface from the zero level of the blended field; null without a field");
  f("edge_length_ratio", j.edge_length_ratio, "ratio",
    "Edges of the first row over the neighbouring border edges");
  f("border_dihedral", j.border_dihedral, "deg",
    "Angle between the normals of kept and new faces across the border; 0 = flat");
  f("border_normal_step", j.border_normal_step, "deg",
    "Angle between the shading normals of kept and new faces at both ends of each border edge; 0 = no seam "
    "to be seen, more where the input is hard or flat there");
  f("border_color_step", j.border_color_step, "1/255",
    "Difference of base colour across the border as an engine shows it; null without new faces");
  f("symmetry", j.symmetry, "-", "Mirror symmetry; null without new faces");
}

template <class F>
void describe(const MeshReport& m, F& f) {
  f("vertices", m.vertices, "count", "Vertices of the result, seams not counted twice");
  f("faces", m.faces, "count", "Polygons of the result");
  f("quads", m.quads, "count", "Polygons with four corners");
  f("triangles", m.triangles, "count", "Polygons with three corners");
  f("kept_faces", m.kept_faces, "count", "Faces copied from the inputs unchanged");
  f("kept_share", m.kept_share, "ratio", "Of all faces of the result");
  f("components", m.components, "count", "Connected pieces");
  f("open_edges_inherited", m.open_edges_inherited, "count", "Open edges that the inputs had already");
  f("non_manifold_edges_inherited", m.non_manifold_edges_inherited, "count",
    "Edges of more than two faces that the inputs had already");
  f("bind_size", m.bind_size, "m", "Width, height and depth of the bind pose's bounding box");
}

template <class F>
void describe(const WeightsReport& w, F& f) {
  f("max_influences", w.max_influences, "count", "Most joints that move one vertex");
  f("cut_vertices", w.cut_vertices, "count",
    "Vertices that had more joints than are written and lost the lightest");
  f("cut_weight_max", w.cut_weight_max, "ratio",
    "Most weight that one of them lost; the rest was scaled up to 1");
  f("row_sum_min", w.row_sum_min, "ratio", "Least sum of a vertex's weights");
  f("row_sum_max", w.row_sum_max, "ratio", "Greatest sum of a vertex's weights");
  f("unweighted_vertices", w.unweighted_vertices, "count", "Vertices that no joint moves");
  f("joints_without_weight", w.joints_without_weight, "text", "Joints that move no vertex");
  f("junction_step", w.junction_step, "ratio",
    "Largest change of a weight row along an edge with a new vertex, 0 = alike, 2 = no joint in common: a "
    "large one tears the junction in motion");
  f("junction_step_blended", w.junction_step_blended, "ratio", "The same before smoothing");
  f("neighbour_step", w.neighbour_step, "ratio", "The same on kept surface within two edges of a junction");
  f("filled_vertices", w.filled_vertices, "count",
    "Vertices that had no joint left and took the weights of a neighbour");
}

template <class F>
void describe(const FrameRun& r, F& f) {
  f("source", r.source, "index", "Source whose joints are completed");
  f("clip", r.clip, "text", "Clip of that source's input that the frames are taken from");
  f("time", r.time, "s", "Where the run begins in the result's clip");
  f("clip_begin", r.clip_begin, "s", "First frame taken, in the source's clip");
  f("clip_end", r.clip_end, "s", "Last frame taken; less than clip_begin when the motion runs backwards");
  f("frames", r.frames, "count", "Frames in the run");
}

template <class F>
void describe(const PosedReport& p, F& f) {
  f("frames", p.frames, "count", "Frames looked at, evenly spread over the clip");
  f("worst_time", p.worst_time, "s", "The worst of them: most intersections, then folds, then stretch");
  f("intersections", p.intersections, "count",
    "Pairs of triangles there that cut each other and do not at rest: of different sources, or of a "
    "junction");
  f("folds", p.folds, "count", "Edges of junctions there across which the surface folds back on itself");
  f("stretch", p.stretch, "ratio", "Longest edge of junctions there over its length at rest; 0: no junction");
  f("foot_sink", p.foot_sink, "m", "How much farther down a foot goes than in any clip of its input");
  f("foot_slide", p.foot_slide, "m/s",
    "How much faster a foot that stands slides than in any clip of its input");
}

template <class F>
void describe(const TurnedLimb& l, F& f) {
  f("joint", l.joint, "text", "The joint that carries the limb");
  f("degrees", l.degrees, "degree", "How far it was turned");
}

template <class F>
void describe(const ClipReport& c, F& f) {
  f("name", c.name, "text", "Name in the result");
  f("input", c.input, "text", "Input that drives it");
  f("source_clip", c.source_clip, "text", "Its name there");
  f("duration", c.duration, "s", "Time of its last key, as in the source");
  f("keys", c.keys, "count", "Keys over all tracks");
  f("driven_joints", c.driven_joints, "count", "Joints of the result that have a track");
  f("completed_from", c.completed_from, "list",
    "Frames chosen for the other sources (SkinMixer Sec. 8), as runs");
  f("turned_limbs", c.turned_limbs, "list",
    "Limbs of other sources that were turned for the whole clip, so that they do not cut what drives it");
  f("mean_distance", c.mean_distance, "ratio",
    "Mean keyframe distance of the chosen frames, 0 = alike; null: none chosen");
  f("jumps", c.jumps, "count", "Steps between the chosen frames that no clip makes");
  f("playback", c.playback, "text",
    "loop: completed so that the last frame meets the first; once: it need not");
  f("posed", c.posed, "object", "What goes wrong when it moves");
  f("fastest_turn", c.fastest_turn, "rad/s", "Fastest turn of any joint");
  f("fastest_joint", c.fastest_joint, "text", "The joint that turns so fast");
  f("fastest_source_turn", c.fastest_source_turn, "rad/s",
    "Fastest turn of any joint in any clip of the inputs");
  f("turn_ratio", c.turn_ratio, "ratio",
    "fastest_turn over fastest_source_turn; null when nothing turns there");
}

template <class F>
void describe(const GoldenFindingReport& g, F& f) {
  f("group", g.group, "text", "structure, geometry, skin or animation");
  f("name", g.name, "text", "What was compared");
  f("text", g.text, "text", "One sentence with the values and the limit");
  f("is_over", g.is_over, "yes/no", "Whether it is over its threshold");
}

template <class F>
void describe(const GoldenReport& g, F& f) {
  f("file", g.file, "text", "Name of the golden, without folders");
  f("missing", g.missing, "yes/no", "Whether there is none yet");
  f("findings", g.findings, "list", "Every comparison, in the order of the groups");
}

template <class F>
void describe(const Report& r, F& f) {
  f("report_version", r.report_version, "count",
    "Version of this format; raised when a property changes its meaning");
  f("preview", r.preview, "yes or no",
    "Whether this is of a preview: parts side by side, not joined; what is not measured then is empty or 0");
  f("tool", r.tool, "object", "What wrote this report");
  f("recipe", r.recipe, "object", "What was built");
  f("inputs", r.inputs, "list", "The characters that went in, in the recipe's order");
  f("operations", r.operations, "list", "What was done with them, in order");
  f("mesh", r.mesh, "object", "The result's mesh");
  f("weights", r.weights, "object", "The result's skin weights");
  f("junctions", r.junctions, "list", "The surfaces made new between kept parts");
  f("clips", r.clips, "list", "The result's clips");
  f("ledger", r.ledger, "list", "Nothing lost: what became of each thing of each input");
  f("joints", r.joints, "list", "Where each joint of the result comes from");
  f("joint_maps", r.joint_maps, "list", "Which joint of the result stands for each joint of each source");
  f("outputs", r.outputs, "list", "The files that were written, this report excepted");
  f("golden", r.golden, "object", "How the result differs from the golden of the recipe; null without one");
  f("issues", r.issues, "list", "What was odd on the way, repairs of inputs excepted");
}

template <class F>
void describe(const StageTiming& s, F& f) {
  f("stage", s.stage, "text", "Name of the stage");
  f("subject", s.subject, "text", "What it ran on: an input, a clip; empty when there is one only");
  f("outcome", s.outcome, "text", "run, or hit: taken from the cache");
  f("wall", s.wall, "s", "Time from start to end");
  f("cpu", s.cpu, "s", "Processor time");
  f("peak_memory", s.peak_memory, "bytes", "Largest resident size of the process up to the stage's end");
  f("begin", s.begin, "s", "When it began, from the start of the build; null when it did not run in it");
}

template <class F>
void describe(const Timings& t, F& f) {
  f("wall", t.wall, "s", "Whole build");
  f("cpu", t.cpu, "s", "Whole build, all threads");
  f("peak_memory", t.peak_memory, "bytes", "Largest resident size of the process");
  f("stages", t.stages, "list", "Stage by stage");
}

}  // namespace skinforge
