#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "recipe/recipe.h"
#include "recipe/value_reader.h"

/// Values that several parts of a recipe have. Every mismatch throws Error (Usage) with its place.
namespace skinforge {

constexpr double kMaxLength = 1e9;  // ours: metres and factors; keeps sums and products finite

/// ".glb", in lower case; empty where there is none.
std::string extension_of(const std::filesystem::path& path);

/// A path relative to the file it is written in: no address, not absolute, / between folders.
RecipePath read_path(const ValueReader& reader);

/// The name of one of `inputs`.
std::string input_name(const ValueReader& reader, const std::vector<RecipeInput>& inputs);

/// Three numbers of at most `kMaxLength`.
std::array<double, 3> vector3(const ValueReader& reader);

/// One joint, or a list of joints, each once; at least one.
std::vector<std::string> read_joints(const ValueReader& reader);

/// Like `find`, but null is as good as nothing.
std::optional<ValueReader> find_set(const ObjectReader& object, std::string_view key);

/// A list of names, each once.
std::vector<std::string> read_clip_names(const ValueReader& reader);

/// True for "all"; otherwise fills in the names.
bool read_clips(const ValueReader& reader, std::vector<std::string>& names);

}  // namespace skinforge
