#include "process.hpp"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <calligraphy/base/error.hpp>

extern "C" char** environ;

namespace calligraphy {
namespace {

[[noreturn]] void fail(const std::string& program, int error) {
  throw Error(program + " cannot be run: " + std::generic_category().message(error));
}

struct CloseTemporary {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using UnnamedFile = std::unique_ptr<std::FILE, CloseTemporary>;

/// Unnamed: deleted once both sides have closed it.
UnnamedFile temporary_file(const std::string& program) {
  UnnamedFile file(std::tmpfile());
  if (!file) fail(program, errno);
  return file;
}

std::string content(std::FILE* file) {
  std::string text;
  std::rewind(file);
  char buffer[4096];
  while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, file)) text.append(buffer, count);
  return text;
}

/// File descriptors of the child: 0, 1 and 2.
struct FileActions {
  posix_spawn_file_actions_t actions;
  FileActions() { posix_spawn_file_actions_init(&actions); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  ~FileActions() { posix_spawn_file_actions_destroy(&actions); }
  void give(std::FILE* file, int descriptor) { posix_spawn_file_actions_adddup2(&actions, fileno(file), descriptor); }
};

}  // namespace

ProcessResult run_process(const std::vector<std::string>& command, std::string_view input) {
  const std::string& program = command.front();
  const UnnamedFile in = temporary_file(program), out = temporary_file(program), err = temporary_file(program);
  const bool written = std::fwrite(input.data(), 1, input.size(), in.get()) == input.size();
  if (!written || std::fflush(in.get()) != 0) fail(program, errno);
  std::rewind(in.get());

  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  FileActions files;
  files.give(in.get(), STDIN_FILENO);
  files.give(out.get(), STDOUT_FILENO);
  files.give(err.get(), STDERR_FILENO);
  pid_t child = 0;
  if (const int error = posix_spawnp(&child, arguments[0], &files.actions, nullptr, arguments.data(), environ)) {
    fail(program, error);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) fail(program, errno);
  }
  const int exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {exit_code, content(out.get()), content(err.get())};
}

}  // namespace calligraphy
