#include "output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <new>

#include <CLI/CLI.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>

namespace calligraphy::tools {
namespace {

std::FILE* own_output = nullptr;  ///< null: `stdout`

CLI::Option* add_out(CLI::App& command, std::string& out, const std::string& description) {
  const auto is_named = [](const std::string& word) {
    return word.empty() ? std::string("the name is empty") : std::string();
  };
  return command.add_option("-o,--out", out, description)->check(CLI::Validator(is_named, ""));
}

}  // namespace

std::FILE* output() noexcept { return own_output != nullptr ? own_output : stdout; }

void keep_output_to_ourselves() {
  if (own_output != nullptr) return;
  std::fflush(stdout);
  const int own = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (own < 0) return;  // there is none
  own_output = fdopen(own, "w");
  if (own_output == nullptr) throw std::bad_alloc();
  dup2(STDERR_FILENO, STDOUT_FILENO);
}

CLI::Option* add_out_file(CLI::App& command, std::string& out) {
  return add_out(command, out, "File to write; - is standard output")
      ->required(out.empty())
      ->capture_default_str()
      ->type_name("FILE");
}

CLI::Option* add_out_directory(CLI::App& command, RunOutput& out, const std::string& what) {
  const auto is_directory = [](const std::string& word) {
    return word == standard_output ? std::string("several files are written, into a directory; ./- is one named -")
                                   : std::string();
  };
  CLI::Option* const option = add_out(command, out.directory,
                                      "Directory for " + what +
                                          ", created if missing. It is refused if a run is already there; other files "
                                          "stay, except those of the same name")
                                  ->check(CLI::Validator(is_directory, ""))
                                  ->type_name("DIR");
  command
      .add_flag("--force", out.force,
                "Replace the run that is in DIR: first remove the files that its record lists, and the record")
      ->disable_flag_override()
      ->needs(option);
  return option;
}

void check_output(const std::string& out) {
  if (out != standard_output) check_can_write(out);
}

void write_output(const std::string& out, std::string_view content) {
  if (out != standard_output) return write_file(out, content);
  if (std::fwrite(content.data(), 1, content.size(), output()) != content.size() || std::fflush(output()) != 0) {
    throw FileError("cannot write to standard output");
  }
}

}  // namespace calligraphy::tools
