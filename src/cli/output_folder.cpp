#include "cli/output_folder.h"

#include <fstream>

#include "base/error.h"
#include "base/text.h"

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
    const fs::path path = folder_ / file.name, temporary = path.string() + ".part";
    std::ofstream stream(temporary, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(file.bytes.data()),
                 static_cast<std::streamsize>(file.bytes.size()));
    stream.close();
    if (!stream) fs::remove(temporary, failure);
    if (!stream) throw Error(ExitCode::StageFailed, printable(path.string()) + ": cannot be written");
    fs::rename(temporary, path, failure);
    if (failure) throw Error(ExitCode::StageFailed, printable(path.string()) + ": " + failure.message());
    paths.push_back(path.string());
  }
  return paths;
}

}  // namespace skinforge
