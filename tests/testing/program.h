#pragma once

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace skinforge::testing {

/// How a program ended and what it said.
struct ProgramResult {
  int status = 0;  ///< exit status; 128 + signal when a signal ended it
  std::string out;
  std::string err;
};

/// A running program whose stdout and stderr are pipes. Variables are added to the environment; TERM, CI,
/// NO_COLOR and SKINFORGE_CACHE are unset unless given.
class Program {
 public:
  Program(const std::string& path, std::vector<std::string> arguments, const std::filesystem::path& folder,
          const std::map<std::string, std::string>& variables = {}) {
    if (::pipe2(out_.data(), O_CLOEXEC) != 0 || ::pipe2(err_.data(), O_CLOEXEC) != 0)
      throw std::runtime_error("cannot make a pipe");
    process_ = ::fork();
    if (process_ == 0) become(path, arguments, folder, variables);
    ::close(out_[1]);
    ::close(err_[1]);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program() {
    if (process_ > 0) finish();
  }

  void send(int signal) const { ::kill(process_, signal); }
  int stdout_descriptor() const { return out_[0]; }

  /// Reads everything it says until it ends.
  ProgramResult finish() {
    ProgramResult result;
    std::array<pollfd, 2> open = {{{out_[0], POLLIN, 0}, {err_[0], POLLIN, 0}}};
    while (open[0].fd >= 0 || open[1].fd >= 0) {
      ::poll(open.data(), open.size(), -1);
      for (std::size_t i = 0; i < open.size(); ++i)
        if (open[i].revents != 0) read_some(open[i], i == 0 ? result.out : result.err);
    }
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = -1;
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return result;
  }

 private:
  [[noreturn]] void become(const std::string& path, std::vector<std::string>& arguments,
                           const std::filesystem::path& folder,
                           const std::map<std::string, std::string>& variables) const {
    ::dup2(out_[1], STDOUT_FILENO);
    ::dup2(err_[1], STDERR_FILENO);
    for (const char* name : {"TERM", "CI", "NO_COLOR", "CLICOLOR_FORCE", "SKINFORGE_CACHE"}) ::unsetenv(name);
    for (const auto& [name, value] : variables) ::setenv(name.c_str(), value.c_str(), 1);
    std::vector<char*> words = {const_cast<char*>(path.c_str())};
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    if (::chdir(folder.c_str()) == 0) ::execv(path.c_str(), words.data());
    ::_exit(127);
  }

  static void read_some(pollfd& from, std::string& text) {
    std::array<char, 4096> buffer;
    const ssize_t got = ::read(from.fd, buffer.data(), buffer.size());
    if (got > 0) {
      text.append(buffer.data(), static_cast<std::size_t>(got));
    } else {
      ::close(from.fd);
      from.fd = -1;
    }
  }

  std::array<int, 2> out_{}, err_{};
  pid_t process_ = -1;
};

}  // namespace skinforge::testing
