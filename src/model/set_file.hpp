// The bytes of a set file and its index (docs/set-file.md).
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <calligraphy/model/character_set.hpp>

#include "mapped_file.hpp"
#include "set_format.hpp"

namespace calligraphy {

/// Opening validates the header and the index, and their checksum; the checksum of a group is verified on its first
/// use. A matching checksum does not make numbers trustworthy: each is validated before use.
class SetFile {
 public:
  /// @throws FormatError naming the file
  SetFile(std::vector<std::byte> bytes, std::string name);
  SetFile(std::unique_ptr<const MappedFile> file, std::string name);

  enum class Found { nothing, other_orders, this_order };

  /// Finds the form of a character with this stroke order and stores it in `form`.
  static Found find(const std::shared_ptr<const SetFile>& file, char32_t code, std::string_view order,
                    StoredCharacter& form) noexcept;
  /// Stores the first form of a character in `form`, if there is one.
  static void find_first(const std::shared_ptr<const SetFile>& file, char32_t code, StoredCharacter& form) noexcept;
  /// All undamaged forms.
  static std::vector<StoredCharacter> find_all(const std::shared_ptr<const SetFile>& file, char32_t code);
  std::optional<char32_t> next(char32_t from) const noexcept;

  const std::string& name() const noexcept { return name_; }
  std::span<const std::byte> bytes() const noexcept { return bytes_; }
  std::size_t size() const noexcept { return size_; }
  const Provenance& provenance() const noexcept { return provenance_; }
  double coordinate_error() const noexcept { return coordinate_error_; }
  const set_format::InkCode& ink_code() const noexcept { return ink_code_; }
  /// The kinds of strokes, by rank.
  std::span<const set_format::StrokeKind> kinds() const noexcept { return kinds_; }

 private:
  /// Position of the forms of a character [byte]; empty if that part is damaged.
  struct Record {
    std::size_t begin = 0;
    std::size_t end = 0;
  };

  /// Which of 64 neighbouring blocks have a group, and the number of groups before them.
  struct BlockCell {
    std::uint64_t present = 0;
    std::uint32_t before = 0;
  };

  void read();
  void read_header();
  /// Reads the kinds; returns, like read_ink_code(), the offset of the next part.
  std::size_t read_kinds();
  std::size_t read_ink_code(std::size_t at);
  void add_kind(std::uint8_t id, std::optional<std::uint8_t> curves);
  void read_provenance(std::size_t at);
  void check_text(const std::string& text) const;
  void read_directory(std::size_t at);
  void check_group(std::size_t group);
  [[noreturn]] void fail(const std::string& what) const;

  std::uint32_t block(std::size_t group) const noexcept;
  std::uint64_t present(std::size_t group) const noexcept;
  std::size_t group_begin(std::size_t group) const noexcept;
  std::size_t group_end(std::size_t group) const noexcept;
  /// Number of groups in lower blocks: the index of this block's group, if it has one.
  std::size_t groups_before(std::uint32_t block) const noexcept;
  bool has_group(std::uint32_t block) const noexcept;
  bool is_intact(std::size_t group) const noexcept;
  std::optional<Record> record(char32_t code) const noexcept;
  /// Reads the head of a form. Returns false if it is damaged; the form then has no strokes.
  bool read_form(Record& rest, StoredCharacter& form) const noexcept;

  enum class GroupState : std::uint8_t { unknown, intact, damaged };

  std::string name_;
  std::vector<std::byte> own_;
  std::unique_ptr<const MappedFile> file_;
  std::span<const std::byte> bytes_;
  Provenance provenance_;
  CoordinateEncoding coding_;
  set_format::InkCode ink_code_;
  std::vector<set_format::StrokeKind> kinds_;
  double coordinate_error_ = 0.0;
  std::size_t group_count_ = 0;
  std::size_t first_group_ = 0;
  std::size_t size_ = 0;
  const std::byte* blocks_ = nullptr;
  const std::byte* entries_ = nullptr;
  std::array<BlockCell, (set_format::last_block >> 6) + 1> cells_{};
  /// Every thread computes the same value, so no memory ordering is needed.
  mutable std::unique_ptr<std::atomic<GroupState>[]> states_;
};

}  // namespace calligraphy
