#include "people.hpp"

#include <memory>

#include "base/parallel.hpp"

namespace calligraphy_test {

using namespace calligraphy;

namespace {

constexpr int samples = 32;  // of a stroke

std::vector<Point> sampled(const StrokeLine& line) {
  std::vector<Point> points;
  for (int i = 0; i < samples; ++i) points.push_back(line.at(line.length() * i / (samples - 1)));
  return points;
}

Point mean_of(const std::vector<Point>& points) {
  Point sum = Point::Zero();
  for (const Point& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

/// A page of what a person wrote, and the pen that draws it again.
class PersonsPage {
 public:
  PersonsPage(const RightPen& person, const SequenceOptions& options)
      : options_(options),
        page_(page_of(person.character, options.em)),
        strokes_(stroke_lines(page_.characters.front())),
        drawn_(laid_on(strokes_, person.paths)),
        pen_(pen_for(page_, options)) {}

  std::size_t size() const { return strokes_.size(); }
  double length(std::size_t k) const { return strokes_[k].length() / options_.em; }
  bool is_finished(std::size_t k) const { return pen_->written() > k; }

  /// On a new page if need be.
  void make_due(std::size_t k) {
    if (pen_->written() == k) return;
    pen_ = pen_for(page_, options_);
    for (std::size_t i = 0; i < k; ++i) pen_->draw(strokes_[i], options_.em);
  }
  Drawn draw(std::size_t k) { return pen_->draw(drawn_[k], options_.em); }
  Drawn draw_part(std::size_t k, double from, double to) { return pen_->draw(drawn_[k].part(from, to), options_.em); }

  /// Draws the person's stroke after this one, or rests in the air after the last.
  Drawn go_on_from(std::size_t k) { return k + 1 < size() ? draw(k + 1) : pen_->rest(final_rest); }
  bool is_confirmed(std::size_t k, const Drawn& next) const { return k + 1 < size() ? next.went_on : next.finished; }

  bool write_exactly(std::size_t k) {
    for (int i = 0; i < 3 && !is_finished(k); ++i) pen_->draw(strokes_[k], options_.em);
    return is_finished(k);
  }

 private:
  SequenceOptions options_;
  PracticePage page_;
  std::vector<StrokeLine> strokes_, drawn_;
  std::unique_ptr<Pen> pen_;
};

/// What `write` returns of each pen, in parallel: rows with a due stroke.
template <typename Row, typename Write>
std::vector<Row> of_each(const std::vector<RightPen>& pens, const SequenceOptions& options,
                         const std::function<void(double)>& progress, Write&& write) {
  std::vector<std::vector<Row>> rows(pens.size());
  parallel_for(
      pens.size(), options.threads, progress ? progress : [](double) {},
      [&](std::size_t i) {
        PersonsPage page(pens[i], options);
        rows[i] = write(page);
        for (Row& row : rows[i]) {
          row.due.pen = i;
          row.due.character = pens[i].character.code;
          row.due.length = page.length(static_cast<std::size_t>(row.due.stroke));
        }
      });
  std::vector<Row> all;
  for (const auto& of_pen : rows) all.insert(all.end(), of_pen.begin(), of_pen.end());
  return all;
}

DueStroke due_stroke(std::size_t k) { return {0, 0, static_cast<int>(k), 0.0}; }

std::vector<FirstTouch> first_touches(PersonsPage& page) {
  std::vector<FirstTouch> touches;
  Drawn drawn;
  bool is_drawn = false;  // this one, since it finished the stroke before
  bool goes_on = true;
  for (std::size_t k = 0; k < page.size(); ++k) {
    FirstTouch& touch = touches.emplace_back();
    touch.due = due_stroke(k);
    if (!goes_on) continue;
    if (!is_drawn) {
      page.make_due(k);
      drawn = page.draw(k);
    }
    is_drawn = false;
    touch.begun = drawn.started;
    touch.at_lift = touch.with_next = page.is_finished(k);
    if (touch.at_lift) continue;
    drawn = page.go_on_from(k);
    touch.with_next = page.is_confirmed(k, drawn);
    touch.mistaken = !touch.with_next && page.is_finished(k);
    is_drawn = touch.with_next;
    goes_on = page.write_exactly(k);
  }
  return touches;
}

std::vector<FirstTouch> touches_of_parts(PersonsPage& page, const PersonsPart& part) {
  std::vector<FirstTouch> touches;
  for (std::size_t k = 0; k < page.size(); ++k) {
    page.make_due(k);
    if (page.length(k) >= part.shortest) {
      FirstTouch& touch = touches.emplace_back();
      touch.due = due_stroke(k);
      touch.begun = page.draw_part(k, part.from, part.to).started;
      touch.at_lift = touch.with_next = page.is_finished(k);
      if (!touch.at_lift) {
        touch.with_next = page.is_confirmed(k, page.go_on_from(k));
        touch.mistaken = !touch.with_next && page.is_finished(k);
      }
      page.make_due(k);
    }
    page.draw(k);
    if (!page.write_exactly(k)) break;
  }
  return touches;
}

std::vector<Redone> redone_strokes(PersonsPage& page, double share) {
  std::vector<Redone> all;
  for (std::size_t k = 0; k + 1 < page.size(); ++k) {
    page.make_due(k);
    page.draw_part(k, 0.0, share);
    if (page.is_finished(k)) continue;
    const Drawn again = page.draw(k);
    const bool next = again.went_on || page.is_finished(k + 1);
    all.push_back({due_stroke(k), page.is_finished(k) && !next, next});
    if (!page.write_exactly(k)) break;
  }
  return all;
}

}  // namespace

std::vector<StrokeLine> laid_on(const std::vector<StrokeLine>& strokes, std::span<const PenPath> paths) {
  std::vector<StrokeLine> lines;
  std::vector<Point> to, from;
  for (std::size_t k = 0; k < strokes.size(); ++k) {
    std::vector<Point> path = paths[k];
    if (path.size() < 2) path.push_back(path.front());
    lines.emplace_back(std::move(path));
    const std::vector<Point> of_stroke = sampled(strokes[k]), of_line = sampled(lines.back());
    to.insert(to.end(), of_stroke.begin(), of_stroke.end());
    from.insert(from.end(), of_line.begin(), of_line.end());
  }
  const Point to_mean = mean_of(to), from_mean = mean_of(from);
  double product = 0.0, square = 0.0;
  for (std::size_t i = 0; i < to.size(); ++i) {
    product += (from[i] - from_mean).dot(to[i] - to_mean);
    square += (from[i] - from_mean).squaredNorm();
  }
  const double scale = square > 0.0 ? product / square : 0.0;
  for (StrokeLine& line : lines) {
    line = line.moved([&](const Point& point, double) { return Point(to_mean + scale * (point - from_mean)); });
  }
  return lines;
}

std::vector<FirstTouch> draw_people(const std::vector<RightPen>& pens, const SequenceOptions& options,
                                    const std::function<void(double)>& progress) {
  return of_each<FirstTouch>(pens, options, progress, first_touches);
}

std::vector<FirstTouch> draw_parts_of_people(const std::vector<RightPen>& pens, const PersonsPart& part,
                                             const SequenceOptions& options,
                                             const std::function<void(double)>& progress) {
  return of_each<FirstTouch>(pens, options, progress, [&](PersonsPage& page) { return touches_of_parts(page, part); });
}

std::vector<Redone> redo_strokes(const std::vector<RightPen>& pens, double share, const SequenceOptions& options,
                                 const std::function<void(double)>& progress) {
  return of_each<Redone>(pens, options, progress, [&](PersonsPage& page) { return redone_strokes(page, share); });
}

}  // namespace calligraphy_test
