#include <calligraphy/model/character_set.hpp>

#include <algorithm>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/set_encoding.hpp>

#include "base/archive_format.hpp"
#include "set_file.hpp"

namespace calligraphy {
namespace {

/// Whether this is a set file, possibly damaged: no text begins like one.
bool begins_like_a_set_file(std::span<const std::byte> bytes) {
  return !bytes.empty() && bytes[0] == static_cast<std::byte>(set_format::magic[0]);
}

/// @throws FormatError if the file is an archive, which a parser's message would not explain
void check_is_no_archive(std::span<const std::byte> bytes, const std::string& path) {
  const std::string_view format = archive_format({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  if (format.empty()) return;
  throw FormatError(path + ": is " + (format == "tar" ? "an archive" : "a compressed archive") + " (" +
                    std::string(format) +
                    "), not a character file; `calligraphy import` converts collections, as directories or archives");
}

}  // namespace

CharacterSet::CharacterSet(Layers layers) : layers_(std::make_shared<const Layers>(std::move(layers))) {}

CharacterSet::CharacterSet() : CharacterSet(Layers()) {}

CharacterSet::CharacterSet(const CharacterList& list)
    : CharacterSet(from_bytes(encode_character_set(list, CoordinatePrecision::exact), "characters in memory")) {}

CharacterSet CharacterSet::open(const std::string& path) {
  auto file = std::make_unique<const MappedFile>(path);
  check_is_no_archive(file->bytes(), path);
  if (!begins_like_a_set_file(file->bytes())) return CharacterSet(read_characters(path));
  return CharacterSet(Layers{std::make_shared<const SetFile>(std::move(file), path)});
}

CharacterSet CharacterSet::from_bytes(std::vector<std::byte> bytes, std::string name) {
  return CharacterSet(Layers{std::make_shared<const SetFile>(std::move(bytes), std::move(name))});
}

CharacterSet CharacterSet::layered(std::span<const CharacterSet> sets) {
  Layers all;
  for (const CharacterSet& set : sets) all.insert(all.end(), set.layers_->begin(), set.layers_->end());
  return CharacterSet(std::move(all));
}

std::optional<StoredCharacter> CharacterSet::find(char32_t code, std::string_view order) const noexcept {
  std::optional<StoredCharacter> found(std::in_place);
  const SharedFile* with_others = nullptr;
  for (const SharedFile& layer : *layers_) {
    const SetFile::Found what = SetFile::find(layer, code, order, *found);
    if (what == SetFile::Found::this_order) return found;
    if (what == SetFile::Found::other_orders && with_others == nullptr) with_others = &layer;
  }
  if (order.empty() && with_others != nullptr) {
    SetFile::find_first(*with_others, code, *found);
  } else {
    found.reset();
  }
  return found;
}

std::vector<std::string> CharacterSet::orders(char32_t code) const {
  std::vector<std::string> names;
  for (const StoredCharacter& form : forms(code)) {
    if (std::find(names.begin(), names.end(), form.order()) == names.end()) names.emplace_back(form.order());
  }
  return names;
}

std::vector<StoredCharacter> CharacterSet::forms(char32_t code) const {
  std::vector<StoredCharacter> all;
  for (const auto& layer : *layers_) {
    for (StoredCharacter& form : SetFile::find_all(layer, code)) all.push_back(std::move(form));
  }
  return all;
}

std::optional<char32_t> CharacterSet::next(char32_t from) const noexcept {
  std::optional<char32_t> least;
  for (const auto& layer : *layers_) {
    const std::optional<char32_t> own = layer->next(from);
    if (own && (!least || *own < *least)) least = own;
  }
  return least;
}

std::size_t CharacterSet::size() const noexcept {
  if (layers_->size() == 1) return layers_->front()->size();
  std::size_t count = 0;
  for (std::optional<char32_t> code = next(0); code; code = next(*code + 1)) ++count;
  return count;
}

std::size_t CharacterSet::bytes() const noexcept {
  std::size_t sum = 0;
  for (const auto& layer : *layers_) sum += layer->bytes().size();
  return sum;
}

std::vector<Provenance> CharacterSet::provenances() const {
  std::vector<Provenance> all;
  for (const auto& layer : *layers_) all.push_back(layer->provenance());
  return all;
}

double CharacterSet::coordinate_error() const noexcept {
  double largest = 0.0;
  for (const auto& layer : *layers_) largest = std::max(largest, layer->coordinate_error());
  return largest;
}

CharacterList CharacterSet::list() const {
  CharacterList all;
  if (!layers_->empty()) all.provenance = layers_->front()->provenance();
  for (std::optional<char32_t> code = next(0); code; code = next(*code + 1)) {
    for (const std::string& order : orders(*code)) all.characters.push_back(find(*code, order)->character());
  }
  return all;
}

void CharacterSet::check() const {
  for (const auto& layer : *layers_) {
    for (std::optional<char32_t> code = layer->next(0); code; code = layer->next(*code + 1)) {
      for (const StoredCharacter& form : SetFile::find_all(layer, *code)) form.character();
    }
  }
}

}  // namespace calligraphy
