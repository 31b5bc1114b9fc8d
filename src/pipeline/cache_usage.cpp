#include "pipeline/cache_usage.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "pipeline/cache_layout.h"
#include "pipeline/json_number.h"

namespace skinforge {
using nlohmann::json;
using namespace cache_layout;

namespace {
CacheUsage read_usage(const BlobStore& store, const std::string& path) {
  const std::optional<Bytes> bytes = read_record(store, path);
  const json document = bytes ? json::parse(text_of(*bytes), nullptr, false) : json();
  CacheUsage usage;
  if (!document.is_object()) return usage;
  try {
    usage = {whole_number(document.at("builds")), whole_number(document.at("hits")),
             whole_number(document.at("runs")), document.at("saved_seconds"), document.at("spent_seconds")};
  } catch (const json::exception&) {
    return {};
  } catch (const Error&) {
    return {};
  }
  return usage;
}
}  // namespace

CacheUsage& CacheUsage::operator+=(const CacheUsage& other) {
  builds += other.builds;
  hits += other.hits;
  runs += other.runs;
  saved_seconds += other.saved_seconds;
  spent_seconds += other.spent_seconds;
  return *this;
}

void note_usage(BlobStore& store, const std::string& session, const CacheUsage& usage) {
  const std::string path = run_path(kUsage, session);
  CacheUsage sum = read_usage(store, path);
  sum += usage;
  const json document = {{"builds", sum.builds},
                         {"hits", sum.hits},
                         {"runs", sum.runs},
                         {"saved_seconds", sum.saved_seconds},
                         {"spent_seconds", sum.spent_seconds}};
  store.write(path, bytes_of(document.dump()));
}

CacheUsage total_usage(const BlobStore& store) {
  CacheUsage sum;
  for (const DigestEntry& entry : entries(store, kUsage)) sum += read_usage(store, entry.path);
  return sum;
}

}  // namespace skinforge
