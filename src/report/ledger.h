#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/character.h"

namespace skinforge {

enum class LedgerKind : std::uint8_t { Clip, Joint, Material, UvSet, Image, MorphTarget };
enum class LedgerState : std::uint8_t { Kept, Changed, Dropped };

/// What became of one thing that an input brought.
struct LedgerEntry {
  LedgerKind kind = LedgerKind::Clip;
  std::string input;
  std::string item;
  LedgerState state = LedgerState::Kept;
  std::vector<std::string> results;  ///< its names in the result, in the result's order
  std::string reason;                ///< why it changed or was dropped
};

/// The nothing-lost ledger: one entry for each thing of each input, by kind, input and the input's order.
using Ledger = std::vector<LedgerEntry>;

/// Where one thing of the result comes from.
struct Origin {
  int input = -1;      ///< index of the input; -1: made new
  int index = -1;      ///< in that input's table
  std::string change;  ///< what is different from there; empty: nothing

  auto operator<=>(const Origin&) const = default;
};

/// One origin per thing of the result, table by table. A result with a part made new (a junction) has origins
/// of input -1.
struct ResultOrigins {
  std::vector<Origin> joints;
  std::vector<Origin> clips;
  std::vector<Origin> materials;
  std::vector<Origin> images;
  std::vector<Origin> morphs;
  std::vector<Origin> parts;  ///< mesh parts; their UV sets come along in order
};

/// Why a thing is not in the result, where the general sentence for its kind would say too little.
struct DropReason {
  LedgerKind kind = LedgerKind::Joint;
  int input = 0;
  int index = 0;
  std::string reason;
};

struct LedgerInput {
  std::string name;  ///< as in the recipe
  const Character* character = nullptr;
};

/// Sets every clip, joint, material, UV set, image and morph target of the inputs against the result. An item
/// is Kept when one of its results has neither a change nor another name, Changed when it has results but
/// each differs (the reason lists how), Dropped when nothing comes from it. Each table of `origins` has one
/// entry per thing of `result` (SF_EXPECT). Linear in all items.
Ledger build_ledger(std::span<const LedgerInput> inputs, const Character& result,
                    const ResultOrigins& origins, std::span<const DropReason> drop_reasons = {});

/// Names as the report writes them: "clip", "uv-set", ...; "kept", ...
std::string_view to_string(LedgerKind kind);
std::string_view to_string(LedgerState state);

}  // namespace skinforge
