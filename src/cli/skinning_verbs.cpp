#include "cli/verb_tree.h"

namespace skinforge {

void VerbTree::add_skinning_verbs() {
  CLI::App* bind = add_verb(&app, "bind", "Give a model without a skin bones and weights", Verb::Bind);
  add_rig_options(bind);
  bind->add_option("--influences", line.skinning.influences, "Joints a vertex follows at most: 4 or 8")
      ->check(CLI::IsMember(std::vector<std::size_t>{4, 8}).description(""))
      ->type_name("N")
      ->default_str("4")
      ->group("Output");
  bind->add_option("--joint", line.skinning.joint, "Joint whose weights are drawn")
      ->type_name("NAME")
      ->default_str("the one with most vertices")
      ->group("Output");
  CLI::App* deform =
      add_verb(&app, "deform", "Write the shapes of a clip by a skinning method", Verb::Deform);
  add_rig_options(deform);
  add_frame_options(deform);
  deform
      ->add_option("--deform", line.skinning.deform_method,
                   "lbs, dqs, poisson, context, context-face or context-polar")
      ->check(CLI::IsMember({"lbs", "dqs", "poisson", "context", "context-face", "context-polar"})
                  .description(""))
      ->type_name("METHOD")
      ->default_str("lbs")
      ->group("Frames");
  deform->add_option("--format", line.skinning.format, "obj or ply")
      ->check(CLI::IsMember({"obj", "ply"}).description(""))
      ->type_name("FORMAT")
      ->default_str("obj")
      ->group("Output");
  CLI::App* compare = add_verb(&app, "compare-skinning", "Measure and draw a clip by every skinning method",
                               Verb::CompareSkinning);
  add_rig_options(compare);
  add_frame_options(compare);
}

// What makes a model with a skin of the files that are named.
void VerbTree::add_rig_options(CLI::App* verb) {
  SkinningRequest& request = line.skinning;
  verb->add_option("MODEL", line.file, "Model: .obj, .off, .glb, .fbx, ...")->required()->type_name("");
  verb->add_option("--skeleton", request.skeleton,
                   "Bones: a .tgf file, or a model whose joints and clips to take")
      ->type_name("FILE")
      ->default_str("the model's own")
      ->group("Skin");
  verb->add_option("--method", request.bind_method,
                   "How to bind: harmonic (over the surface from handles) or heat (through the inside)")
      ->check(CLI::IsMember({"harmonic", "heat"}).description(""))
      ->type_name("METHOD")
      ->default_str("harmonic")
      ->group("Skin");
  verb->add_option("--handles", request.handles,
                   "Vertices that bones hold alone: rule, groups, skin, a .dmat of labels, a .json of "
                   "vertex lists, or a "
                   "painted .png")
      ->type_name("WHAT")
      ->default_str("rule")
      ->group("Skin");
  verb->add_option("--label-colors", request.label_colors,
                   "Colours of a painted image by joint, as {\"Head\": \"#ff8000\"}")
      ->type_name("FILE")
      ->group("Skin");
  verb->add_option("--poses", request.poses, "Rotations of all bones, a .dmat file each; becomes a clip")
      ->type_name("FILE")
      ->group("Skin");
  verb->add_option("--rate", request.rate_hz, "Frames a second of those, 1 to 240")
      ->check(CLI::Range(1.0, 240.0).description(""))
      ->type_name("HZ")
      ->default_str("30")
      ->group("Skin");
  verb->add_option("-o,--out", line.out, "Output folder")
      ->type_name("DIR")
      ->default_str("out/<model>")
      ->group("Output");
}

void VerbTree::add_frame_options(CLI::App* verb) {
  constexpr std::size_t kMaxFrames = 100000;  // ours: an hour at 30 a second
  SkinningRequest& request = line.skinning;
  verb->add_option("--clip", request.clip, "Clip to play")
      ->type_name("NAME")
      ->default_str("the first")
      ->group("Frames");
  verb->add_option("--frames", request.frames, "Frames, evenly over the clip")
      ->check(CLI::Range(std::size_t{1}, kMaxFrames).description(""))
      ->type_name("N")
      ->default_str("24")
      ->group("Frames");
  verb->add_option("--example", request.examples,
                   "A shape of the model and its pose, for the context methods")
      ->type_name("SHAPE POSE")
      ->expected(2)
      ->take_all()
      ->group("Examples");
  verb->add_flag("!--no-rest", request.with_rest, "Do not take the rest pose as one more example")
      ->group("Examples");
  verb->add_option("--kernel", request.kernel, "How examples share between them: linear or gaussian")
      ->check(CLI::IsMember({"linear", "gaussian"}).description(""))
      ->type_name("KERNEL")
      ->default_str("linear")
      ->group("Examples");
  verb->add_option("--driver-joint", request.driver_joints,
                   "A joint by whose rotation poses are compared; may be given several times")
      ->type_name("NAME")
      ->default_str("all but roots")
      ->group("Examples");
}

}  // namespace skinforge
