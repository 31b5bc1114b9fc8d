#include "report/ledger.h"

#include <algorithm>
#include <array>
#include <map>

#include "base/expect.h"

namespace skinforge {
namespace {

constexpr std::array<std::string_view, 6> kKinds{"clip",   "joint", "material",
                                                 "uv-set", "image", "morph-target"};
constexpr std::array<std::string_view, 3> kStates{"kept", "changed", "dropped"};

// Said when the caller knows no better.
constexpr std::array<std::string_view, 6> kDropped{
    "not asked for by the recipe",
    "below a joint that was replaced or removed, or not part of what was taken",
    "no face of the result uses it",
    "no face of its mesh part is in the result",
    "no material of the result uses it",
    "no vertex that it moves is in the result"};

/// Names of one table: of an input or of the result.
using Names = std::vector<std::string>;

template <class Items>
Names names_of(const Items& items) {
  Names names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

Names uv_set_names(const PolygonMesh& mesh) {
  Names names;
  for (const MeshPart& part : mesh.parts)
    for (int set = 0; set < part.uv_sets; ++set) names.push_back(part.name + " UV" + std::to_string(set));
  return names;
}

Names names_of(const Character& character, LedgerKind kind) {
  switch (kind) {
    case LedgerKind::Clip:
      return names_of(character.clips);
    case LedgerKind::Joint:
      return character.skeleton.names();
    case LedgerKind::Material:
      return names_of(character.materials);
    case LedgerKind::UvSet:
      return uv_set_names(character.mesh);
    case LedgerKind::Image:
      return names_of(character.images);
    case LedgerKind::MorphTarget:
      return names_of(character.morphs);
  }
  return {};
}

// Index in the input's list of all UV sets of the first set of `part`.
int first_uv_set(const PolygonMesh& mesh, int part) {
  int first = 0;
  for (int p = 0; p < part; ++p) first += mesh.parts[static_cast<std::size_t>(p)].uv_sets;
  return first;
}

// The origin of each UV set of the result, from the origins of its mesh parts. Sets beyond those of the
// source are new.
std::vector<Origin> uv_set_origins(std::span<const LedgerInput> inputs, const Character& result,
                                   std::span<const Origin> parts) {
  std::vector<Origin> origins;
  for (std::size_t p = 0; p < result.mesh.parts.size(); ++p)
    for (int set = 0; set < result.mesh.parts[p].uv_sets; ++set) {
      Origin origin = parts[p];
      if (origin.input >= 0) {
        const PolygonMesh& mesh = inputs[static_cast<std::size_t>(origin.input)].character->mesh;
        const bool exists = set < mesh.parts[static_cast<std::size_t>(origin.index)].uv_sets;
        if (exists)
          origin.index = first_uv_set(mesh, origin.index) + set;
        else
          origin = {};
      }
      origins.push_back(origin);
    }
  return origins;
}

std::vector<Origin> origins_of(LedgerKind kind, std::span<const LedgerInput> inputs, const Character& result,
                               const ResultOrigins& origins) {
  switch (kind) {
    case LedgerKind::Clip:
      return origins.clips;
    case LedgerKind::Joint:
      return origins.joints;
    case LedgerKind::Material:
      return origins.materials;
    case LedgerKind::UvSet:
      return uv_set_origins(inputs, result, origins.parts);
    case LedgerKind::Image:
      return origins.images;
    case LedgerKind::MorphTarget:
      return origins.morphs;
  }
  return {};
}

void add_reason(std::string& reason, const std::string& more) {
  if (reason.find(more) != std::string::npos) return;
  reason += (reason.empty() ? "" : "; ") + more;
}

std::string drop_reason(const LedgerEntry& entry, int input, int index, std::span<const DropReason> reasons) {
  const auto found = std::find_if(reasons.begin(), reasons.end(), [&](const DropReason& r) {
    return r.kind == entry.kind && r.input == input && r.index == index;
  });
  if (found != reasons.end()) return found->reason;
  return std::string(kDropped[static_cast<std::size_t>(entry.kind)]);
}

// Adds one result to the entry of the thing it comes from. UV sets are named after their part, so a new name
// alone changes nothing.
void add_result(LedgerEntry& entry, const std::string& name, const Origin& origin, bool& has_unchanged) {
  entry.results.push_back(name);
  const bool is_renamed = entry.kind != LedgerKind::UvSet && name != entry.item;
  if (origin.change.empty() && !is_renamed) has_unchanged = true;
  if (is_renamed) add_reason(entry.reason, "renamed");
  if (!origin.change.empty()) add_reason(entry.reason, origin.change);
}

void add_kind(Ledger& ledger, LedgerKind kind, std::span<const LedgerInput> inputs, const Character& result,
              const ResultOrigins& result_origins, std::span<const DropReason> drop_reasons) {
  const Names result_names = names_of(result, kind);
  const std::vector<Origin> origins = origins_of(kind, inputs, result, result_origins);
  SF_EXPECT(origins.size() == result_names.size());
  std::map<std::pair<int, int>, std::vector<std::size_t>> results;
  for (std::size_t i = 0; i < origins.size(); ++i) results[{origins[i].input, origins[i].index}].push_back(i);

  for (int input = 0; input < static_cast<int>(inputs.size()); ++input) {
    const Names names = names_of(*inputs[static_cast<std::size_t>(input)].character, kind);
    for (int index = 0; index < static_cast<int>(names.size()); ++index) {
      LedgerEntry entry{kind,
                        inputs[static_cast<std::size_t>(input)].name,
                        names[static_cast<std::size_t>(index)],
                        LedgerState::Dropped,
                        {},
                        ""};
      bool has_unchanged = false;
      const auto found = results.find({input, index});
      if (found == results.end()) {
        entry.reason = drop_reason(entry, input, index, drop_reasons);
      } else {
        for (const std::size_t i : found->second)
          add_result(entry, result_names[i], origins[i], has_unchanged);
        entry.state = has_unchanged ? LedgerState::Kept : LedgerState::Changed;
        if (has_unchanged) entry.reason.clear();
      }
      ledger.push_back(std::move(entry));
    }
  }
}

}  // namespace

Ledger build_ledger(std::span<const LedgerInput> inputs, const Character& result,
                    const ResultOrigins& origins, std::span<const DropReason> drop_reasons) {
  SF_EXPECT(origins.parts.size() == result.mesh.parts.size());
  Ledger ledger;
  for (std::size_t kind = 0; kind < kKinds.size(); ++kind)
    add_kind(ledger, static_cast<LedgerKind>(kind), inputs, result, origins, drop_reasons);
  return ledger;
}

std::string_view to_string(LedgerKind kind) {
  return kKinds[static_cast<std::size_t>(kind)];
}

std::string_view to_string(LedgerState state) {
  return kStates[static_cast<std::size_t>(state)];
}

}  // namespace skinforge
