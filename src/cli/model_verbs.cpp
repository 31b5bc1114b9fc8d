#include "cli/verb_tree.h"

namespace skinforge {

void VerbTree::add_model_verbs() {
  CLI::App* inspect =
      add_verb(&app, "inspect", "Show what a model holds: joints, clips, weights, topology", Verb::Inspect);
  inspect->add_option("FILE", line.file, "Model: .glb, .gltf, .fbx, .dae, .obj, ...")
      ->required()
      ->type_name("");
  add_diff_verb();
  CLI::App* verify =
      add_verb(&app, "verify", "Check that a GLB is as it was written, and what it was made of (status 4)",
               Verb::Verify);
  verify->add_option("FILE", line.file, "A GLB that this tool made")->required()->type_name("");
  verify->add_option("--recipe", recipe, "Recipe to compare with: what it asks for, and its files")
      ->type_name("RECIPE");
  add_choice_options(verify);
  add_repair_verbs();
}

void VerbTree::add_diff_verb() {
  DiffRequest& request = line.diff;
  CLI::App* diff = add_verb(
      &app, "diff", "Compare two models: structure, surface, weights, every clip, pictures (status 5)",
      Verb::Diff);
  diff->add_option("A", request.a, "Model to compare with")->required()->type_name("");
  diff->add_option("B", request.b, "Model to compare")->required()->type_name("");
  diff->add_option("--threshold", request.thresholds,
                   "What is still the same: geometry and animation in % of A's diagonal (0.001%, 0.05%), "
                   "normals (1 degree), uv (0.1% of the texture), weights (0.01 of 2), duration (0.001 s), "
                   "picture (0.1% of the character's pixels), structure (none, or any edits)")
      ->type_name("NAME=LIMIT")
      ->group("Verdict");
  diff->add_flag("--accept", request.accept, "Put B in the place of A, with a note beside it of what changed")
      ->group("Verdict");
  diff->add_option("--html", request.html,
                   "Write a page with both side by side, one camera and one clock, and where they differ")
      ->type_name("FILE")
      ->group("Output");
  CLI::Option* pictures = diff->add_option("--pictures", request.pictures,
                                           "Write the drawings side by side with what differs, as PNG")
                              ->type_name("DIR")
                              ->group("Output");
  diff->add_flag("--no-pictures", request.without_pictures, "Draw nothing")
      ->group("Verdict")
      ->excludes(pictures);
  diff->add_option("--junit", request.junit, "Write the verdicts as JUnit XML, too")
      ->type_name("FILE")
      ->group("Output");
  diff->add_option("--sarif", request.sarif, "Write what is over its limit as SARIF, too")
      ->type_name("FILE")
      ->group("Output");
  add_jobs_option(diff);
}

void VerbTree::add_repair_verbs() {
  CLI::App* validate =
      add_verb(&app, "validate", "Check a glTF or GLB file against the rules of the format (status 4)",
               Verb::Validate);
  validate->add_option("FILE", line.file, "A .glb or .gltf")->required()->type_name("");
  validate->add_flag("--strict", line.strict, "Warnings count, too")->group("Verdict");
  validate
      ->add_flag("--own-rules", line.without_khronos, "Do not ask the Khronos validator, even if it is there")
      ->group("Verdict");
  CLI::App* repair =
      add_verb(&app, "repair", "Write a model anew as a valid GLB, and say each thing that was repaired",
               Verb::Repair);
  repair->add_option("FILE", line.file, "Model: .glb, .gltf, .fbx, .dae, .obj, ...")
      ->required()
      ->type_name("");
  repair->add_option("-o,--out", line.out, "File to write")
      ->type_name("FILE.glb")
      ->default_str("FILE with the ending .repaired.glb")
      ->group("Output");
  repair->add_option("--influences", line.influences, "Joints a vertex follows at most: 4 or 8")
      ->check(CLI::IsMember(std::vector<std::size_t>{4, 8}).description(""))
      ->type_name("N")
      ->default_str("8 where the model has more than 4")
      ->group("Output");
}

}  // namespace skinforge
