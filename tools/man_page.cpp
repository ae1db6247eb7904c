#include "man_page.hpp"

#include <fmt/format.h>

namespace calligraphy::tools {
namespace {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";  // a hyphen may not be copied into a command line
    } else {
      result += c;
    }
  }
  return result;
}

/// A line of text: one that begins with a dot or a quote would be a request.
std::string line(const std::string& text) {
  const bool is_request = text.starts_with('.') || text.starts_with('\'');
  return (is_request ? "\\&" : "") + escaped(text) + "\n";
}

std::string paragraph(const std::string& title, const std::string& text) { return ".TP\n.B " + line(title) + line(text); }

std::string paragraph(const ArgumentText& argument) {
  std::string text = argument.description;
  if (!argument.default_value.empty()) text += " (default: " + argument.default_value + ")";
  return paragraph(signature(argument), text);
}

std::string examples(const CommandText& command) {
  std::string text;
  for (const std::string& each : command.examples) text += line(each);
  return text.empty() ? "" : ".PP\n.nf\n" + text + ".fi\n";
}

/// A command, and those below it.
std::string section(const CommandText& command, const std::string& name) {
  std::string text = ".SS " + line(name) + line(command.description) + ".PP\n.B " + line(usage(command));
  for (const ArgumentText& argument : command.positional) text += paragraph(argument);
  for (const ArgumentText& option : command.options) text += paragraph(option);
  text += examples(command);
  for (const CommandText& each : command.commands) text += section(each, name + " " + own_name(each));
  return text;
}

}  // namespace

std::string man_page(const CommandText& program, const std::string& version) {
  std::string text = ".\\\" -*- coding: UTF-8 -*-\n.TH CALLIGRAPHY 1 \"\" " + line("\"calligraphy " + version + "\"");
  text += ".SH NAME\ncalligraphy \\- haptic guidance for writing Chinese characters\n";
  text += ".SH SYNOPSIS\n.B " + line(usage(program)) + ".SH DESCRIPTION\n" + line(program.description);
  text += examples(program) + ".SH OPTIONS\n";
  for (const ArgumentText& option : program.options) text += paragraph(option);
  text += ".SH COMMANDS\n";
  for (const CommandText& each : program.commands) text += section(each, own_name(each));
  text += ".SH EXIT STATUS\n";
  text += paragraph("0", "The work is done, or space or Esc stopped it.");
  text += paragraph("1", "It failed. What is wrong is told in one line on standard error.");
  text += paragraph("2", "The command line is wrong.");
  text += line("After Ctrl-C, or another signal that ends programs, the program writes the results so far and ends by it.");
  text += ".SH ENVIRONMENT\n";
  text += paragraph("CALLIGRAPHY_WIRE_PROFILE", "Wire profile of a Phantom where --wire-profile is not given.");
  text += paragraph("CALLIGRAPHY_LIBHD", "The vendor's library for openhaptics, where it is not found by its name.");
  text += paragraph("COLUMNS", "Width of the help where standard output is no terminal.");
  text += ".SH FILES\n";
  return text + paragraph("docs/*.md", "What is named like this is installed in share/doc/calligraphy.");
}

}  // namespace calligraphy::tools
