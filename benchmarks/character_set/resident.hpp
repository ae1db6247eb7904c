// How much of a mapped file is in a program's memory.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

/// Resident memory of this program's mappings of a file, as the system counts it [byte]; none where it does not tell.
std::optional<std::size_t> resident_bytes(const std::string& path);

/// Writes the file out and lets the system forget its content, as after a restart.
void forget_content(const std::string& path);
