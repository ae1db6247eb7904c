#include <calligraphy/pictures/pdf.hpp>

#include <cairo-pdf.h>
#include <librsvg/rsvg.h>

#include <memory>

#include <calligraphy/base/error.hpp>

namespace calligraphy {
namespace {

struct Unreference {
  void operator()(RsvgHandle* handle) const { g_object_unref(handle); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};

std::string message_of(GError* error) {
  const std::string message = error != nullptr ? error->message : "unknown error";
  g_clear_error(&error);
  return message;
}

cairo_status_t append_bytes(void* text, const unsigned char* bytes, unsigned int count) noexcept {
  try {
    static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  } catch (...) {
    return CAIRO_STATUS_NO_MEMORY;
  }
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

bool pdf_available() noexcept { return true; }

std::string pdf_of_svg(const std::string& svg) {
  GError* error = nullptr;
  const auto* bytes = reinterpret_cast<const guint8*>(svg.data());
  const std::unique_ptr<RsvgHandle, Unreference> handle(rsvg_handle_new_from_data(bytes, svg.size(), &error));
  if (!handle) throw FormatError("the picture is no SVG: " + message_of(error));
  rsvg_handle_set_dpi(handle.get(), 72.0);  // a point of PDF is 1/72 inch
  double width = 0.0, height = 0.0;
  if (!rsvg_handle_get_intrinsic_size_in_pixels(handle.get(), &width, &height) || !(width > 0.0 && height > 0.0)) {
    throw FormatError("the picture has no size of its own");
  }
  std::string pdf;
  const std::unique_ptr<cairo_surface_t, Unreference> surface(
      cairo_pdf_surface_create_for_stream(append_bytes, &pdf, width, height));
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");  // the same bytes on every day
  {
    const std::unique_ptr<cairo_t, Unreference> context(cairo_create(surface.get()));
    const RsvgRectangle page{0.0, 0.0, width, height};
    if (!rsvg_handle_render_document(handle.get(), context.get(), &page, &error)) {
      throw Error("the PDF cannot be drawn: " + message_of(error));
    }
  }
  cairo_surface_finish(surface.get());
  const cairo_status_t status = cairo_surface_status(surface.get());
  if (status != CAIRO_STATUS_SUCCESS) {
    throw Error(std::string("the PDF cannot be drawn: ") + cairo_status_to_string(status));
  }
  return pdf;
}

}  // namespace calligraphy
