#include "cli/output_folder.h"

#include "base/error.h"
#include "base/text.h"
#include "pipeline/publish.h"

namespace skinforge {
namespace fs = std::filesystem;

void OutputFolder::add(const std::string& name, const std::string& text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  add(name, Bytes(begin, begin + text.size()));
}

std::vector<std::string> OutputFolder::write() const {
  std::error_code failure;
  fs::create_directories(folder_, failure);
  if (failure)
    throw Error(ExitCode::StageFailed,
                printable(folder_.string()) + ": cannot be made: " + failure.message());
  std::vector<std::string> paths;
  for (const File& file : files_)
    for (const fs::path& input : inputs_)
      if (fs::equivalent(folder_ / file.name, input, failure))
        throw Error(ExitCode::Usage,
                    printable((folder_ / file.name).string()) + ": is an input; choose another --out");
  for (const File& file : files_) {
    write_output(folder_ / file.name, file.bytes);
    paths.push_back((folder_ / file.name).string());
  }
  return paths;
}

}  // namespace skinforge
