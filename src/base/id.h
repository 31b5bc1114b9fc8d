#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>

namespace skinforge {

/// Index into one table of one kind; -1 means "none". Ids of different kinds do not mix.
template <class Tag>
struct Id {
  std::int32_t value = -1;

  constexpr Id() = default;
  constexpr explicit Id(std::int32_t v) : value(v) {}
  constexpr explicit Id(std::size_t v) : value(static_cast<std::int32_t>(v)) {}

  constexpr bool is_valid() const { return value >= 0; }
  constexpr std::size_t index() const { return static_cast<std::size_t>(value); }
  auto operator<=>(const Id&) const = default;
};

using JointId = Id<struct JointTag>;
using VertexId = Id<struct VertexTag>;
using FaceId = Id<struct FaceTag>;
using MaterialId = Id<struct MaterialTag>;
using ImageId = Id<struct ImageTag>;
using PartId = Id<struct PartTag>;      ///< a mesh object of the source file
using SourceId = Id<struct SourceTag>;  ///< a placed input: 0 is the base, others are grafted in order

}  // namespace skinforge
