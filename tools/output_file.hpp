// Where a command writes: the option --out.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace calligraphy::tools {

/// In place of a file's name.
inline constexpr const char* standard_output = "-";

/// The program's own standard output, to which alone its results may be printed.
std::FILE* output() noexcept;

/// From here on, what anything else prints to standard output goes to standard error: a vendor's library greets there
/// from its own code, at any time until the program has ended.
void keep_output_to_ourselves();

/// Adds -o, --out FILE; required unless `out` has a value, the default.
CLI::Option* add_out_file(CLI::App& command, std::string& out);

/// Where a run writes its files.
struct RunOutput {
  std::string directory;  ///< empty: nowhere
  bool force = false;     ///< a run that is there is replaced
};

/// Adds -o, --out DIR, where `what` is to be written, as in "plots and JSON", and --force.
CLI::Option* add_out_directory(CLI::App& command, RunOutput& out, const std::string& what);

/// Before long work. @throws FileError if the file cannot be written
void check_output(const std::string& out);

/// Writes the whole file or none, or to standard output. @throws FileError
void write_output(const std::string& out, std::string_view content);

}  // namespace calligraphy::tools
