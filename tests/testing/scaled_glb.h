#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace skinforge::testing {

/// Writes a GLB file again with all its lengths multiplied: positions, morph offsets, translations of nodes
/// and of animations, translation part of inverse bind matrices. Trusts its input: float accessors, one
/// buffer.
class ScaledGlb {
 public:
  static void write(const std::filesystem::path& from, const std::filesystem::path& to, double factor) {
    ScaledGlb(from, factor).save(to);
  }

 private:
  using Json = nlohmann::json;

  ScaledGlb(const std::filesystem::path& path, double factor) : factor_(factor) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, 4);
    json_ = Json::parse(bytes.substr(20, length));
    binary_ = bytes.substr(20 + length + 8);
    scale_nodes();
    scale_meshes();
    scale_bind_matrices();
    scale_animations();
  }

  void scale_nodes() {
    for (Json& node : json_["nodes"]) {
      if (node.contains("translation"))
        for (Json& x : node["translation"]) x = x.get<double>() * factor_;
      if (node.contains("matrix"))
        for (std::size_t i = 12; i < 15; ++i) node["matrix"][i] = node["matrix"][i].get<double>() * factor_;
    }
  }

  void scale_meshes() {
    for (const Json& mesh : json_["meshes"])
      for (const Json& primitive : mesh["primitives"]) {
        scale_accessor(primitive["attributes"]["POSITION"]);
        for (const Json& target : primitive.value("targets", Json::array()))
          if (target.contains("POSITION")) scale_accessor(target["POSITION"]);
      }
  }

  void scale_bind_matrices() {
    for (const Json& skin : json_.value("skins", Json::array()))
      if (skin.contains("inverseBindMatrices"))
        scale_accessor(skin["inverseBindMatrices"], [](std::size_t i) { return i >= 12 && i < 15; });
  }

  void scale_animations() {
    for (const Json& animation : json_.value("animations", Json::array()))
      for (const Json& channel : animation["channels"])
        if (channel["target"]["path"] == "translation")
          scale_accessor(animation["samplers"][channel["sampler"].get<std::size_t>()]["output"]);
  }

  template <class Predicate>
  void scale_accessor(const Json& index, const Predicate& is_length) {
    if (!done_.insert(index.get<std::size_t>()).second) return;
    Json& accessor = json_["accessors"][index.get<std::size_t>()];
    const Json& view = json_["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const std::size_t width = accessor["type"] == "MAT4" ? 16 : 3;
    const std::size_t stride = view.value("byteStride", 4 * width);
    const std::size_t begin =
        view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0});
    for (std::size_t e = 0; e < accessor["count"].get<std::size_t>(); ++e)
      for (std::size_t i = 0; i < width; ++i)
        if (is_length(i)) scale_float(begin + e * stride + 4 * i);
    for (const char* bound : {"min", "max"})
      if (accessor.contains(bound))
        for (std::size_t i = 0; i < width; ++i)
          if (is_length(i))
            accessor[bound][i] =
                static_cast<double>(static_cast<float>(accessor[bound][i].get<double>() * factor_));
  }
  void scale_accessor(const Json& index) {
    scale_accessor(index, [](std::size_t) { return true; });
  }

  void scale_float(std::size_t offset) {
    float value = 0;
    std::memcpy(&value, binary_.data() + offset, 4);
    value = static_cast<float>(value * factor_);
    std::memcpy(binary_.data() + offset, &value, 4);
  }

  void save(const std::filesystem::path& path) const {
    std::string text = json_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::ofstream file(path, std::ios::binary);
    const auto word = [&](std::size_t value) {
      const auto bits = static_cast<std::uint32_t>(value);
      file.write(reinterpret_cast<const char*>(&bits), 4);
    };
    file << "glTF";
    word(2);
    word(12 + 8 + text.size() + 8 + binary_.size());
    word(text.size());
    file << "JSON" << text;
    word(binary_.size());
    file << std::string("BIN\0", 4) << binary_;
  }

  double factor_;
  Json json_;
  std::string binary_;
  std::set<std::size_t> done_;
};

}  // namespace skinforge::testing
