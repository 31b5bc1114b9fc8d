#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/archive.h"
#include "base/issue.h"
#include "model/polygon_mesh.h"
#include "model/skin_weights.h"
#include "surface/border.h"

namespace skinforge {

struct SelectionOptions {
  int smoothing_passes = 1;  ///< Sec. 6: one pass of Laplacian smoothing of the presence
  double clamp = 0.02;       ///< Sec. 6: values this near to 0 or 1 count as such and are not smoothed
  double keep_variance =
      0.04;                ///< Sec. 6: a component whose presence varies less is kept or dropped whole ...
  double keep_mean = 0.5;  ///< ... by whether its mean presence is above this
  double hardness = 0;  ///< (-1, 1): above 0 the presence stays high further into the cut, below 0 it falls
                        ///< sooner; p^g with g = (1 - h) / (1 + h), as the program of the paper's authors

  template <class Archive>
  friend void fields(Archive& a, SelectionOptions& o) {
    a(o.smoothing_passes, o.clamp, o.keep_variance, o.keep_mean, o.hardness);
  }
};

/// One cut through one source: the joints of its input that one operation takes away. For a donor these are
/// all joints outside the grafted sub-tree.
struct Cut {
  std::size_t site = 0;
  std::vector<bool> removed;  ///< per joint of the input
  SelectionOptions options;
  bool is_of_added = false;  ///< of the part that an operation adds: its sheets stay as far as they fade
};

/// How a connected component of a source takes part.
enum class ComponentRole : std::uint8_t {
  Blended,
  KeptWhole,
  DroppedWhole,
  Sheet,  ///< cut as it is and fused with nothing: an open surface that is all but flat has no inside
};

/// What stays of one source (SkinMixer Sec. 6), before any field is known.
struct SourceSelection {
  std::vector<double> presence;                    ///< #V, least over all cuts, in [0, 1]
  std::vector<std::size_t> cut_sites;              ///< the sites that cut this source
  std::vector<std::vector<double>> site_presence;  ///< per entry of `cut_sites`, #V
  FaceSet kept;                                    ///< #F, faces of uniform presence 1
  std::vector<std::int32_t> face_site;             ///< #F, site that discards the face; -1 while it is kept
  std::vector<ComponentRole> face_role;            ///< #F

  template <class Archive>
  friend void fields(Archive& a, SourceSelection& s) {
    a(s.presence, s.cut_sites, s.site_presence, s.kept, s.face_site, s.face_role);
  }
};

/// Presence per vertex: the sum of its weights on joints that stay, clamped near 0 and 1, then smoothed
/// between (Sec. 6, "Automatic vertex selection") and bent by the hardness.
std::vector<double> presence_of_cut(const PolygonMesh& mesh, const SkinWeights& weights,
                                    const std::vector<bool>& removed, const SelectionOptions& options);

/// Faces that are preserved unmodified, and secondary components kept or dropped whole (Sec. 6, Fig. 7).
/// Where we leave the paper: a component that has faces wholly 1 and faces wholly 0 is always blended,
/// however small its variance, because a hand cut off a one-piece body varies by less than 0.04 over the
/// whole body. Of several cuts the one that leaves least of a component decides how. `place` leads the
/// issues.
SourceSelection select_faces(const PolygonMesh& mesh, const SkinWeights& weights, std::span<const Cut> cuts,
                             const std::string& place, IssueSink& issues);

}  // namespace skinforge
