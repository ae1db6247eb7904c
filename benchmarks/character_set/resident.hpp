// How much of a mapped file is resident in memory.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

/// Resident memory of this program's mappings of a file, as counted by the system [byte]; empty where the system does
/// not report it.
std::optional<std::size_t> resident_bytes(const std::string& path);

/// Writes the file to disk and drops its content from the cache, as after a restart.
void forget_content(const std::string& path);
