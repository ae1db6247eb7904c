// The program `calligraphy`. Exit codes: 0 success, 1 failure, 2 usage error; or ended by a signal.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <span>
#include <string>

#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <calligraphy/devices/emergency_stop.hpp>

#include "command_text.hpp"
#include "commands.hpp"
#include "help_page.hpp"
#include "interrupt.hpp"
#include "mistyped.hpp"
#include "output_file.hpp"
#include "run_record.hpp"

namespace {

/// Prints one line, even if the message quotes control characters.
int fail(int code, std::string message) noexcept {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
  std::replace_if(message.begin(), message.end(), is_control, ' ');
  std::fflush(calligraphy::tools::output());
  std::fprintf(stderr, "calligraphy: %s\n", message.c_str());
  return code;
}

int flush() noexcept {
  std::cout.flush();
  return std::fflush(calligraphy::tools::output()) == 0 && std::cout ? 0 : fail(1, "cannot write to standard output");
}

class HelpFormatter final : public CLI::FormatterBase {
  std::string make_help(const CLI::App* command, std::string, CLI::AppFormatMode) const override {
    using namespace calligraphy::tools;
    return help_page(command_text(*command), help_width());
  }
};

int run(int argc, char** argv) {
  calligraphy::install_emergency_stop();
  std::signal(SIGXFSZ, SIG_IGN);  // exceeding the file size limit is a write error
  spdlog::set_default_logger(spdlog::stderr_logger_st("calligraphy"));
  spdlog::set_pattern("%n: %l: %v");

  CLI::App program(
      "Haptic guidance for writing Chinese characters: a person writes with a force-feedback pen, which pulls the hand "
      "along each stroke, in the right order and direction. Everything works on a simulated device too.",
      "calligraphy");
  program.require_subcommand(0, 1);  // so that the words after `help` are none
  program.formatter(std::make_shared<HelpFormatter>());
  program.set_version_flag("-V,--version", "calligraphy " CALLIGRAPHY_VERSION, "Print the version");
  program.set_help_flag("-h,--help", "Print this help");
  program.footer(
      "calligraphy write 永 -o out    # a simulated writer, without and with force\n"
      "calligraphy help write         # what else it can do\n"
      "calligraphy devices            # which real devices are connected");
  calligraphy::tools::add_write(program);
  calligraphy::tools::add_strokes(program);
  calligraphy::tools::add_info(program);
  calligraphy::tools::add_tradeoff(program);
  calligraphy::tools::add_stability(program);
  calligraphy::tools::add_import(program);
  calligraphy::tools::add_traces(program);
  calligraphy::tools::add_validate(program);
  calligraphy::tools::add_replay(program);
  calligraphy::tools::add_devices(program);
  calligraphy::tools::add_help(program);
  calligraphy::tools::add_completion(program);
  const std::span<const char* const> words(argv + 1, argv + argc);
  if (words.empty()) {
    fmt::print(stderr, "{}", program.help());
    return 2;
  }
  calligraphy::tools::check_words(calligraphy::tools::command_text(program), words);
  calligraphy::tools::remember_command(words);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) return fail(2, error.what());
    program.exit(error);  // help and version
  }
  return flush();
}

int run_and_report(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const calligraphy::tools::UsageError& error) {
    return fail(2, error.what());
  } catch (const std::bad_alloc&) {
    return fail(1, "out of memory");
  } catch (const std::exception& error) {
    return fail(1, error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int code = run_and_report(argc, argv);
  calligraphy::tools::end_if_interrupted();
  return code;
}
