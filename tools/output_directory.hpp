// The output directory of a run.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace calligraphy::tools {

// The records of runs: the commands that write into a directory have one each.
inline constexpr const char* summary_file = "summary.json";
inline constexpr const char* replay_file = "replay.json";
inline constexpr const char* stability_file = "stability.json";
inline constexpr const char* tradeoff_file = "tradeoff.json";

inline constexpr const char* recording_suffix = ".recording.gz";  ///< of the files that a person's work is in

/// Creates the directory and its parents if missing; the destructor removes those it created that are still empty, and
/// nothing else. No other run may use it in the meantime: the system's lock on the directory goes with the process,
/// however it ends. Where there are no such locks (some network file systems) it is not locked.
///
/// The directory explains itself: a record in JSON says from the start what is run, and lists every file before it is
/// written, so that a run that was killed is explained too. A run whose record is there, of whichever command, is never overwritten,
/// unless that is forced; then the files that its record lists are removed, and no others. A recording of no run is
/// never overwritten either. A run that ends by an exception before it has written a file leaves no record.
class OutputDirectory {
 public:
  /// @param record name of the record
  /// @param force replaces a run that is there
  /// @throws FileError naming the directory if no file can be written into it, or another run uses it; naming the
  /// record and its run if there is one
  OutputDirectory(const std::filesystem::path& path, std::string record, bool force);
  ~OutputDirectory();
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;

  /// Adds to the record what is known at the start. @throws FileError
  void explain(const nlohmann::ordered_json& facts);
  /// Writes the whole file or none. @throws FileError
  void write(const std::string& name, std::string_view content);
  /// Where a file is to be written that grows; the record lists it. @throws FileError
  std::filesystem::path reserve(const std::string& name);
  /// Gives such a file another name, in place of one that is there. @throws FileError
  void rename(const std::string& from, const std::string& to);
  /// Removes such a file. @throws FileError
  void remove(const std::string& name);
  /// Adds results to the record, in place of those that it has; it then stays. @throws FileError
  void keep(const nlohmann::ordered_json& results);
  /// Says in the record that the run is finished. @throws FileError
  void finish();
  /// The text of the record.
  std::string text() const;

 private:
  void create(const std::filesystem::path& path);
  void lock(const std::filesystem::path& path);
  void check_writable(const std::filesystem::path& path) const;
  void make_room(const std::filesystem::path& path, const char* record, bool force) const;
  void refuse_strangers(const std::filesystem::path& path) const;
  void write_record();
  void release() noexcept;

  std::filesystem::path path_;
  std::string name_;                            ///< of the record
  nlohmann::ordered_json record_;               ///< without the files
  std::vector<std::string> files_;              ///< in the order in which they were written
  bool has_record_ = false;                     ///< this run's record is there
  bool has_results_ = false;                    ///< with results in it
  std::vector<std::filesystem::path> created_;  ///< parents first
  int lock_ = -1;                               ///< descriptor of the locked directory; -1: not locked
};

}  // namespace calligraphy::tools
