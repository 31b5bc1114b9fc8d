#include "stages/junction_symmetry.h"

#include <algorithm>

namespace skinforge {
namespace {

// The same on both sides: what one side loses to an order of faces or a last bit the other loses, too.
void clean_alike(std::span<PreservedSource> sources, const PreserveOptions& options,
                 const std::optional<SourceMirror>& mirror, std::span<const std::int32_t> image) {
  constexpr int kRounds = 8;  // ours: two are enough on the real characters
  for (int round = 0; round < kRounds; ++round) {
    for (PreservedSource& source : sources) clean_borders(source, options);
    if (!mirror || discard_images(sources, *mirror, image) == 0) return;
  }
}

}  // namespace

std::vector<JunctionLoop> loops_of(std::span<const PreservedSource> sources, const JunctionSite& site,
                                   std::vector<JunctionLoop>& arcs) {
  std::vector<JunctionLoop> loops;
  for (const SiteParticipant& p : site.solids.participants) {
    auto found = loops_of_sites(sources[p.source.index()], p.source, site.group, p.is_host, arcs);
    loops.insert(loops.end(), std::make_move_iterator(found.begin()), std::make_move_iterator(found.end()));
  }
  return loops;
}

BuildSymmetry::BuildSymmetry(const std::vector<JunctionSite>& sites, std::span<const PreservedSource> sources)
    : sites_(sites), mirror_(find_source_mirror(sources)) {
  std::size_t operations = 0;
  for (const JunctionSite& site : sites) operations = std::max(operations, site.group.back() + 1);
  image_.assign(operations, -1);
  reason_.assign(operations,
                 mirror_ ? "its parts are not placed as mirror images" : "the base has no plane of symmetry");
  if (!mirror_) return;
  for (const JunctionSite& a : sites)
    for (const JunctionSite& b : sites)
      if (are_mirror_images(*mirror_, a.solids.participants, b.solids.participants))
        for (const std::size_t k : a.group)
          image_[k] = static_cast<std::int32_t>(b.first()), reason_[k].clear();
}

const JunctionSite& BuildSymmetry::site_with(std::int32_t first) const {
  return *std::find_if(sites_.begin(), sites_.end(),
                       [&](const JunctionSite& s) { return static_cast<std::int32_t>(s.first()) == first; });
}

void BuildSymmetry::give_up(std::size_t site, const std::string& reason) {
  for (const JunctionSite& s : sites_) {
    if (s.first() != site) continue;
    for (const std::size_t k : s.group) image_[k] = -1, reason_[k] = reason;
  }
}

std::vector<PreservedSource> BuildSymmetry::cleaned(std::vector<PreservedSource> sources,
                                                    const PreserveOptions& options) {
  while (true) {
    std::vector<PreservedSource> result = sources;
    clean_alike(result, options, mirror_, image_);
    bool all_alike = true;
    for (const JunctionSite& site : sites_) {
      const std::int32_t image = image_[site.first()];
      if (image < 0 || of(site, result).site >= 0) continue;
      for (const std::size_t k : {site.first(), static_cast<std::size_t>(image)})
        give_up(k, "its borders are not mirror images");
      all_alike = false;
    }
    if (all_alike) return result;
  }
}

JunctionSymmetry BuildSymmetry::of(const JunctionSite& site, std::span<const PreservedSource> sources) const {
  JunctionSymmetry symmetry{-1, reason_[site.first()], mirror_ ? mirror_->matched : 0, {}};
  const std::int32_t image = image_[site.first()];
  if (image < 0) return symmetry;
  std::vector<JunctionLoop> arcs;  // what runs along open hems is joined without regard to symmetry
  auto images =
      border_images(*mirror_, loops_of(sources, site, arcs), loops_of(sources, site_with(image), arcs));
  if (!images) return symmetry;
  symmetry.site = image;
  symmetry.borders = {mirror_->plane, *std::move(images)};
  return symmetry;
}

}  // namespace skinforge
