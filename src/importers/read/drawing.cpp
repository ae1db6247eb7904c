#include "drawing.hpp"

#include <cstddef>

#include "anim_cjk.hpp"
#include "hanzi_writer.hpp"
#include "kanjivg.hpp"
#include "order_corrections.hpp"
#include "source_files.hpp"
#include "stroke_labels.hpp"

namespace calligraphy {
namespace {

Drawing pen_drawing(const DrawingFile& file) {
  Drawing drawing = parse_kanjivg(file.text, file.place);
  drawing.notice = with_plain_line_ends(drawing.notice, file.place);
  for (SourceStroke& stroke : drawing.strokes) stroke.label_ids = ids_of_kanjivg_label(stroke.label);
  return drawing;
}

Drawing brush_drawing(const DrawingFile& file, const StrokeLetters& letters, bool corrections) {
  Drawing drawing;
  if (file.form == DrawingForm::anim_cjk) {
    drawing = parse_anim_cjk(file.text, file.place);
    drawing.notice = with_plain_line_ends(drawing.notice, file.place);
  } else {
    drawing.strokes = parse_hanzi_writer(file.text, file.place);
    if (corrections) drawing.correction = correct_order(file.character.code, drawing.strokes);
  }
  const auto found = letters.find(file.character.code);
  if (found == letters.end()) return drawing;
  drawing.letters_unused = found->second.size() != drawing.strokes.size();
  for (std::size_t i = 0; i < drawing.strokes.size() && !drawing.letters_unused; ++i) {
    drawing.strokes[i].label = found->second[i];
    drawing.strokes[i].label_ids = ids_of_stroke_letter(found->second[i]);
  }
  return drawing;
}

}  // namespace

Drawing parse_drawing(const DrawingFile& file, const StrokeLetters& letters, bool corrections) {
  return file.form == DrawingForm::kanjivg ? pen_drawing(file) : brush_drawing(file, letters, corrections);
}

}  // namespace calligraphy
