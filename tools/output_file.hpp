// Where a command writes: the option --out.
#pragma once

#include <string>
#include <string_view>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace calligraphy::tools {

/// In place of a file's name.
inline constexpr const char* standard_output = "-";

/// Adds -o, --out FILE; required unless `out` has a value, the default.
CLI::Option* add_out_file(CLI::App& command, std::string& out);

/// Adds -o, --out DIR, where `what` is to be written, as in "plots and JSON".
CLI::Option* add_out_directory(CLI::App& command, std::string& out, const std::string& what);

/// Before long work. @throws FileError if the file cannot be written
void check_output(const std::string& out);

/// Writes the whole file or none, or to standard output. @throws FileError
void write_output(const std::string& out, std::string_view content);

}  // namespace calligraphy::tools
