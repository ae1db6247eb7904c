#include <calligraphy/model/typical_stroke.hpp>

#include <cstddef>
#include <iterator>
#include <string>

#include <calligraphy/base/error.hpp>

namespace calligraphy {
namespace {

using EmPoint = std::array<double, 2>;

// Typical shapes [em], y up: the path of a pen tip, without the entry and exit of a brush.
constexpr EmPoint heng[] = {{0.10, 0.48}, {0.90, 0.53}};
constexpr EmPoint shu[] = {{0.50, 0.90}, {0.50, 0.10}};
constexpr EmPoint shu_pie[] = {{0.56, 0.90}, {0.57, 0.58}, {0.55, 0.33}, {0.36, 0.10}};
constexpr EmPoint pie[] = {{0.68, 0.88}, {0.62, 0.58}, {0.46, 0.31}, {0.20, 0.12}};
constexpr EmPoint duan_pie[] = {{0.70, 0.60}, {0.30, 0.42}};
constexpr EmPoint na[] = {{0.18, 0.86}, {0.34, 0.56}, {0.56, 0.25}, {0.86, 0.14}};
constexpr EmPoint ping_na[] = {{0.08, 0.46}, {0.32, 0.66}, {0.50, 0.30}, {0.92, 0.32}};
constexpr EmPoint dian[] = {{0.40, 0.60}, {0.60, 0.40}};
constexpr EmPoint zuo_dian[] = {{0.57, 0.63}, {0.43, 0.37}};
constexpr EmPoint ti[] = {{0.32, 0.38}, {0.70, 0.62}};
constexpr EmPoint heng_gou[] = {{0.12, 0.58}, {0.86, 0.64}, {0.77, 0.54}};
constexpr EmPoint shu_gou[] = {{0.54, 0.90}, {0.54, 0.10}, {0.44, 0.18}};
constexpr EmPoint wan_gou[] = {{0.42, 0.90}, {0.56, 0.68}, {0.62, 0.40}, {0.55, 0.10}, {0.45, 0.18}};
constexpr EmPoint xie_gou[] = {{0.28, 0.90}, {0.31, 0.58}, {0.46, 0.27}, {0.76, 0.10}, {0.775, 0.21}};
constexpr EmPoint wo_gou[] = {{0.14, 0.62}, {0.20, 0.30}, {0.50, 0.22}, {0.82, 0.36}, {0.75, 0.46}};
constexpr EmPoint heng_zhe[] = {{0.16, 0.74}, {0.82, 0.79}, {0.76, 0.20}};
constexpr EmPoint heng_pie[] = {{0.24, 0.80}, {0.74, 0.85}, {0.66, 0.56}, {0.48, 0.28}, {0.18, 0.12}};
constexpr EmPoint heng_zhe_gou[] = {{0.22, 0.82}, {0.76, 0.87}, {0.73, 0.10}, {0.63, 0.18}};
constexpr EmPoint heng_zhe_ti[] = {{0.22, 0.72}, {0.52, 0.77}, {0.50, 0.18}, {0.72, 0.38}};
constexpr EmPoint heng_zhe_wan_gou[] = {
    {0.16, 0.76}, {0.58, 0.82}, {0.5452, 0.35}, {0.537, 0.234},
    {0.566, 0.18}, {0.67, 0.18}, {0.88, 0.18}, {0.88, 0.29}};
constexpr EmPoint heng_xie_gou[] = {{0.10, 0.80}, {0.56, 0.87}, {0.53, 0.52}, {0.62, 0.22}, {0.88, 0.12}, {0.89, 0.23}};
constexpr EmPoint heng_xie_wan_gou[] = {
    {0.22, 0.82}, {0.62, 0.87}, {0.36, 0.54}, {0.115, 0.229}, {0.20, 0.18}, {0.84, 0.18}, {0.85, 0.29}};
constexpr EmPoint heng_zhe_wan[] = {
    {0.20, 0.78}, {0.52, 0.83}, {0.50, 0.46}, {0.49, 0.275}, {0.54, 0.24}, {0.84, 0.26}};
constexpr EmPoint heng_zhe_zhe[] = {{0.20, 0.76}, {0.50, 0.79}, {0.50, 0.26}, {0.80, 0.29}};
constexpr EmPoint heng_zhe_zhe_zhe[] = {{0.14, 0.84}, {0.48, 0.87}, {0.47, 0.50}, {0.86, 0.53}, {0.81, 0.14}};
constexpr EmPoint heng_zhe_zhe_pie[] = {
    {0.26, 0.86}, {0.66, 0.91}, {0.54, 0.60}, {0.74, 0.63}, {0.70, 0.43}, {0.54, 0.22}, {0.28, 0.10}};
constexpr EmPoint heng_zhe_zhe_zhe_gou[] = {
    {0.26, 0.86}, {0.66, 0.92}, {0.56, 0.62}, {0.80, 0.66}, {0.79, 0.46}, {0.74, 0.26}, {0.63, 0.11}, {0.53, 0.19}};
constexpr EmPoint heng_pie_wan_gou[] = {
    {0.28, 0.86}, {0.62, 0.91}, {0.48, 0.60}, {0.66, 0.52}, {0.74, 0.32}, {0.60, 0.20}, {0.49, 0.29}};
constexpr EmPoint shu_ti[] = {{0.42, 0.86}, {0.40, 0.18}, {0.68, 0.44}};
constexpr EmPoint shu_wan[] = {{0.32, 0.80}, {0.30, 0.42}, {0.292, 0.268}, {0.36, 0.24}, {0.48, 0.24}, {0.78, 0.24}};
constexpr EmPoint shu_wan_gou[] = {
    {0.32, 0.88}, {0.311, 0.35}, {0.309, 0.234}, {0.336, 0.18}, {0.44, 0.18}, {0.78, 0.18}, {0.78, 0.29}};
constexpr EmPoint shu_zhe[] = {{0.26, 0.80}, {0.26, 0.24}, {0.80, 0.30}};
constexpr EmPoint shu_zhe_pie[] = {{0.48, 0.90}, {0.38, 0.50}, {0.74, 0.55}, {0.69, 0.42}, {0.60, 0.28}, {0.48, 0.12}};
constexpr EmPoint shu_zhe_zhe[] = {{0.30, 0.86}, {0.29, 0.50}, {0.70, 0.54}, {0.69, 0.14}};
constexpr EmPoint shu_zhe_zhe_gou[] = {
    {0.28, 0.88}, {0.26, 0.56}, {0.78, 0.61}, {0.77, 0.42}, {0.73, 0.24}, {0.64, 0.11}, {0.54, 0.19}};
constexpr EmPoint pie_zhe[] = {{0.54, 0.78}, {0.24, 0.26}, {0.78, 0.34}};
constexpr EmPoint pie_dian[] = {{0.48, 0.90}, {0.45, 0.76}, {0.39, 0.62}, {0.30, 0.50}, {0.76, 0.14}};
constexpr EmPoint chang_dian[] = {{0.26, 0.68}, {0.44, 0.60}, {0.62, 0.48}, {0.76, 0.30}};
constexpr EmPoint quan[] = {
    {0.50, 0.90}, {0.279, 0.90}, {0.10, 0.721}, {0.10, 0.50}, {0.10, 0.279}, {0.279, 0.10}, {0.50, 0.10},
    {0.721, 0.10}, {0.90, 0.279}, {0.90, 0.50}, {0.90, 0.721}, {0.721, 0.90}, {0.50, 0.90}};

constexpr TypicalStroke table[] = {
    {1, "横", "héng", "H", "31D0", "L", "", "一 (1st), 大 (1st)", heng},
    {2, "竖", "shù", "S", "31D1", "L", "", "中 (4th)", shu},
    {3, "竖撇", "shùpiě", "SP", "31D3", "C", "", "月 (1st), 川 (1st)", shu_pie},
    {4, "撇", "piě", "P", "31D2", "C", "", "人 (1st), 北 (匕)", pie},
    {5, "短撇/平撇", "duǎnpiě", "P (short/flat)", "31D2 var", "L", "", "千 (1st), 禾 (1st)", duan_pie},
    {6, "捺", "nà", "N", "31CF", "C", "", "大 (3rd)", na},
    {7, "平捺(提捺)", "píngnà", "TN", "31DD", "C", "", "之, 辶 (last), 廴 (last)", ping_na},
    {8, "点", "diǎn", "D", "31D4", "L", "", "主 (1st), 丸 (3rd)", dian},
    {9, "左点", "zuǒdiǎn", "D (left)", "31D4 var", "L", "", "忄 (1st), 心 (1st)", zuo_dian},
    {10, "提", "tí", "T", "31C0", "L", "", "冰 (2nd), 北 (3rd)", ti},
    {11, "横钩", "hénggōu", "HG", "31D6", "LL", "c", "写 (2nd), 皮 (1st)", heng_gou},
    {12, "竖钩", "shùgōu", "SG", "31DA", "LL", "c", "水 (1st), 小 (1st)", shu_gou},
    {13, "弯钩", "wāngōu", "WG", "31C1", "CL", "c", "狐 (2nd), 家", wan_gou},
    {14, "斜钩", "xiégōu", "XG", "31C2", "CL", "c", "我 (5th), 戈", xie_gou},
    {15, "卧钩", "wògōu", "BXG", "31C3", "CL", "c", "心 (2nd)", wo_gou},
    {16, "横折", "héngzhé", "HZ", "31D5", "LL", "c", "口 (2nd), 四 (2nd)", heng_zhe},
    {17, "横撇", "héngpiě", "HP", "31C7", "LC", "c", "又 (1st)", heng_pie},
    {18, "横折钩", "héngzhégōu", "HZG", "31C6", "LLL", "cc", "月 (2nd), 刀", heng_zhe_gou},
    {19, "横折提", "héngzhétí", "HZT", "31CA", "LLL", "cc", "计 (2nd)", heng_zhe_ti},
    {20, "横折弯钩", "héngzhéwāngōu", "HZWG", "31C8", "LLCLL", "cssc", "九 (2nd), 几 (2nd)", heng_zhe_wan_gou,
     "LLLLL"},
    {21, "横斜钩", "héngxiégōu", "HXG", "31E4", "LCL", "cc", "风 (2nd), 飞 (1st)", heng_xie_gou},
    {22, "横斜弯钩", "héngxiéwāngōu", "HXWG", "31E0", "LLCL", "csc", "乙 (1st)", heng_xie_wan_gou},
    {23, "横折弯", "héngzhéwān", "HZW", "31CD", "LLC", "cs", "朵 (2nd), 投 (5th)", heng_zhe_wan},
    {24, "横折折", "héngzhézhé", "HZZ", "31C5", "LLL", "cc", "凹 (2nd)", heng_zhe_zhe},
    {25, "横折折折", "héngzhézhézhé", "HZZZ", "31CE", "LLLL", "ccc", "凸 (4th)", heng_zhe_zhe_zhe},
    {26, "横折折撇", "héngzhézhépiě", "HZZP", "31CB", "LLLC", "ccc", "及 (2nd), 建", heng_zhe_zhe_pie},
    {27, "横折折折钩", "héngzhézhézhégōu", "HZZZG", "31E1", "LLLCL", "cccc", "乃 (1st)", heng_zhe_zhe_zhe_gou},
    {28, "横撇弯钩", "héngpiěwāngōu", "HPWG", "31CC", "LLCL", "ccc", "队 (1st)", heng_pie_wan_gou},
    {29, "竖提", "shùtí", "ST", "31D9", "LL", "c", "民 (3rd), 以 (1st)", shu_ti},
    {30, "竖弯", "shùwān", "SW", "31C4", "LCL", "ss", "四 (4th), 西", shu_wan},
    {31, "竖弯钩", "shùwāngōu", "SWG", "31DF", "LCLL", "ssc", "北, 乱 (7th)", shu_wan_gou, "LLLL"},
    {32, "竖折", "shùzhé", "SZ", "31D7", "LL", "c", "山 (2nd)", shu_zhe},
    {33, "竖折撇", "shùzhépiě", "SZP", "31E5", "LLC", "cc", "专 (3rd)", shu_zhe_pie},
    {34, "竖折折", "shùzhézhé", "SZZ", "31DE", "LLL", "cc", "鼎 (6th), 亞 (4th)", shu_zhe_zhe},
    {35, "竖折折钩", "shùzhézhégōu", "SZWG/SZZG", "31C9", "LLCL", "ccc", "马 (2nd), 弓 (3rd)", shu_zhe_zhe_gou},
    {36, "撇折", "piězhé", "PZ", "31DC", "LL", "c", "公 (3rd), 弘 (4th)", pie_zhe},
    {37, "撇点", "piědiǎn", "PD", "31DB", "CL", "c", "女 (1st)", pie_dian},
    {38, "长点(反捺)", "chángdiǎn", "D/N (long)", "31D4 var", "C", "", "不 (4th)", chang_dian},
    {39, "圈", "quān", "Q", "31E3", "CCCC", "sss", "〇", quan},
};

/// Whether the polygon before-at-after turns by less than 5 degrees.
constexpr bool is_smooth(const EmPoint& before, const EmPoint& at, const EmPoint& after) {
  const double ux = at[0] - before[0], uy = at[1] - before[1];
  const double vx = after[0] - at[0], vy = after[1] - at[1];
  const double cross = ux * vy - uy * vx, dot = ux * vx + uy * vy;
  constexpr double tan_5_degrees = 0.08748866352592401;
  return (cross < 0 ? -cross : cross) < tan_5_degrees * dot;
}

constexpr bool is_consistent(const TypicalStroke& stroke) {
  const auto& elements = stroke.elements;
  if (elements.empty() || elements.size() > max_elements_per_stroke) return false;
  if (elements.find_first_not_of("LC") != std::string_view::npos) return false;
  if (!stroke.printed_elements.empty() && stroke.printed_elements.size() != elements.size()) return false;
  if (stroke.joints.size() + 1 != elements.size()) return false;
  if (stroke.shape.size() != static_cast<std::size_t>(control_point_count(elements))) return false;
  for (const EmPoint& point : stroke.shape) {
    if (point[0] < 0 || point[0] > 1 || point[1] < 0 || point[1] > 1) return false;
  }
  std::size_t at = 0;
  for (std::size_t i = 0; i < stroke.joints.size(); ++i) {
    at += elements[i] == static_cast<char>(ElementKind::line) ? 1 : 3;
    const bool has_curve = elements[i] != elements[i + 1] || elements[i] == static_cast<char>(ElementKind::curve);
    const bool smooth = is_smooth(stroke.shape[at - 1], stroke.shape[at], stroke.shape[at + 1]);
    if (stroke.joints[i] != (has_curve && smooth ? 's' : 'c')) return false;
  }
  return true;
}

/// 0 when every stroke agrees with its elements and the ids count up from 1.
constexpr int first_inconsistent_id() {
  int id = 0;
  for (const TypicalStroke& stroke : table) {
    if (stroke.id != ++id || !is_consistent(stroke)) return id;
  }
  return 0;
}

static_assert(std::size(table) == typical_stroke_count);
static_assert(first_inconsistent_id() == 0);

}  // namespace

std::span<const TypicalStroke> typical_strokes() noexcept { return table; }

const TypicalStroke& typical_stroke(int id) {
  if (id < 1 || id > typical_stroke_count) {
    throw ValueError("typical stroke id " + std::to_string(id) + " is not in 1 to " +
                     std::to_string(typical_stroke_count));
  }
  return table[id - 1];
}

}  // namespace calligraphy
