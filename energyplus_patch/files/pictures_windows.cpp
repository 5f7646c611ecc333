// clang-format off
#include <windows.h>
#include <propidl.h>
#include <gdiplus.h>
// clang-format on

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <sstream>

#include "files/picture_plugin/sheet_layout.h"
#include "files/pictures.h"
#include "gpu_shading/error.h"
#include "platform/text.h"
#include "platform/wide_text.h"

// Pictures drawn and written by GDI+, which every Windows has.

namespace gpu_shading::energyplus {
namespace {

using Gdiplus::Bitmap;

[[noreturn]] void fail(std::string const& name, std::string_view why) {
  throw Error(fmt::format("{}: cannot be drawn: {}", name, why));
}

void check(Gdiplus::Status status, std::string const& name) {
  if (status != Gdiplus::Ok) fail(name, fmt::format("error {} of GDI+", static_cast<int>(status)));
}

// Until the process ends: a library may not wait for threads as it is unloaded.
void start_gdiplus() {
  static bool const started = [] {
    ULONG_PTR token = 0;
    Gdiplus::GdiplusStartupInput const input;
    return Gdiplus::GdiplusStartup(&token, &input, nullptr) == Gdiplus::Ok;
  }();
  if (!started) throw Error("pictures need GDI+ (gdiplus.dll), which cannot be started");
}

// The first that is there; null without any.
std::unique_ptr<Gdiplus::FontFamily> find_font() {
  for (auto const* const name : {L"Segoe UI", L"Arial", L"Tahoma", L"DejaVu Sans"}) {
    auto family = std::make_unique<Gdiplus::FontFamily>(name);
    if (family->IsAvailable()) return family;
  }
  return nullptr;
}

CLSID encoder_of(std::string const& name) {
  struct Format {
    std::string_view ending;
    unsigned char number;
  };
  constexpr Format formats[] = {{".png", 0x06}, {".jpg", 0x01},  {".jpeg", 0x01},
                                {".tif", 0x05}, {".tiff", 0x05}, {".bmp", 0x00}};
  auto const ending = std::filesystem::path(name).extension().string();
  for (auto const& format : formats) {
    if (!same_name(ending, format.ending)) continue;
    // Of GDI+'s own encoders, which differ by a byte.
    return {
        0x557CF400U | format.number, 0x1A04, 0x11D3, {0x9A, 0x73, 0, 0, 0xF8, 0x1E, 0xF3, 0x2E}};
  }
  fail(name, "expected a name that ends in .png, .jpg, .tif or .bmp");
}

class Picture {
 public:
  Picture(std::string name, int width, int height)
      : name_(std::move(name)), bitmap_(started(width), height, PixelFormat24bppRGB) {
    check(bitmap_.GetLastStatus(), name_);
  }

  Picture(std::string const& name, Image const& image) : Picture(name, image.width, image.height) {
    Gdiplus::Rect const all(0, 0, image.width, image.height);
    Gdiplus::BitmapData locked;
    check(bitmap_.LockBits(&all, Gdiplus::ImageLockModeWrite, PixelFormat24bppRGB, &locked), name_);
    constexpr int channels = 3;
    auto const* from = image.pixels.data();
    for (int y = 0; y < image.height; ++y) {
      auto* to = static_cast<unsigned char*>(locked.Scan0) + y * locked.Stride;
      for (int x = 0; x < image.width; ++x, from += image.channels, to += channels) {
        // Blue comes first.
        for (int c = 0; c < channels; ++c)
          to[channels - 1 - c] = from[std::min(c, image.channels - 1)];
      }
    }
    check(bitmap_.UnlockBits(&locked), name_);
  }

  void fill(int x, int y, int width, int height, Gdiplus::Color const& colour) {
    Gdiplus::Graphics graphics(&bitmap_);
    Gdiplus::SolidBrush const brush(colour);
    check(graphics.FillRectangle(&brush, x, y, width, height), name_);
  }

  void paste(Bitmap& other, int x, int y) {
    Gdiplus::Graphics graphics(&bitmap_);
    Gdiplus::Rect const to(x, y, static_cast<int>(other.GetWidth()),
                           static_cast<int>(other.GetHeight()));
    graphics.SetInterpolationMode(Gdiplus::InterpolationModeNearestNeighbor);
    graphics.SetPixelOffsetMode(Gdiplus::PixelOffsetModeHalf);
    check(graphics.DrawImage(&other, to, 0, 0, to.Width, to.Height, Gdiplus::UnitPixel), name_);
  }

  // A picture is of use without its captions.
  void write(Label const& label) {
    Gdiplus::Graphics graphics(&bitmap_);
    graphics.SetTextRenderingHint(Gdiplus::TextRenderingHintAntiAlias);
    auto const family = find_font();
    Gdiplus::Font const font(family.get(), static_cast<float>(label.size),
                             Gdiplus::FontStyleRegular, Gdiplus::UnitPixel);
    Gdiplus::StringFormat format(Gdiplus::StringFormat::GenericTypographic());
    format.SetAlignment(label.align == LabelAlign::left     ? Gdiplus::StringAlignmentNear
                        : label.align == LabelAlign::centre ? Gdiplus::StringAlignmentCenter
                                                            : Gdiplus::StringAlignmentFar);
    format.SetLineAlignment(Gdiplus::StringAlignmentCenter);
    Gdiplus::SolidBrush const black(Gdiplus::Color(0, 0, 0));
    Gdiplus::PointF const at(static_cast<float>(label.x), static_cast<float>(label.y));
    auto const text = to_wide(label.text);
    if (graphics.DrawString(text.c_str(), static_cast<int>(text.size()), &font, at, &format,
                            &black) != Gdiplus::Ok) {
      warn_of_missing_font();
    }
  }

  std::string encode() {
    auto const encoder = encoder_of(name_);
    IStream* opened = nullptr;
    if (CreateStreamOnHGlobal(nullptr, TRUE, &opened) != S_OK) fail(name_, "out of memory");
    auto const release = [](IStream* stream) { stream->Release(); };
    std::unique_ptr<IStream, decltype(release)> const stream(opened, release);
    check(bitmap_.Save(stream.get(), &encoder, nullptr), name_);
    STATSTG facts{};
    stream->Stat(&facts, STATFLAG_NONAME);
    stream->Seek({}, STREAM_SEEK_SET, nullptr);
    std::string bytes(facts.cbSize.QuadPart, '\0');
    ULONG read = 0;
    stream->Read(bytes.data(), static_cast<ULONG>(bytes.size()), &read);
    if (read != bytes.size()) fail(name_, "cannot be encoded");
    return bytes;
  }

 private:
  static int started(int width) {
    start_gdiplus();
    return width;
  }

  static void warn_of_missing_font() {
    static bool const told = [] {
      std::fputs("gpu_shading: warning: no font was found, so that pictures have no captions\n",
                 stderr);
      return true;
    }();
    static_cast<void>(told);
  }

  std::string name_;
  Bitmap bitmap_;
};

void add_scale(Picture& on, SheetLayout const& layout) {
  int const left = layout.bar_left();
  int const top = layout.bar_top();
  int const tall = layout.bar_height();
  for (int y = 0; y < tall; ++y) {
    auto const colour = fraction_colour((tall - 1.0 - y) / (tall - 1.0));
    auto const channel = [&](int c) { return static_cast<BYTE>(std::lround(colour[c])); };
    on.fill(left, top + y, layout.text, 1, {channel(0), channel(1), channel(2)});
  }
  auto const write = [&](int x, int y, char const* text) {
    on.write({x, y, layout.text, LabelAlign::left, text});
  };
  int const numbers = left + layout.text + layout.margin;
  write(numbers, top + tall, "0");
  write(numbers, top + tall - tall / 2, "0.5");
  write(numbers, top, "1");
  write(left, layout.caption - layout.text / 2, "sunlit");
}

}  // namespace

std::string encode_image(std::string const& name, Image const& image) {
  return Picture(name, image).encode();
}

std::string encode_labelled(std::string const& name, Image const& image,
                            std::vector<Label> const& labels) {
  Picture picture(name, image);
  for (auto const& label : labels) picture.write(label);
  return picture.encode();
}

std::string encode_sheet(std::string const& name, PictureSheet const& sheet) {
  start_gdiplus();
  encoder_of(name);  // refuses a format before anything is drawn
  std::vector<std::unique_ptr<Bitmap>> pictures;
  std::vector<PictureSize> sizes;
  CaptionSize captions;
  for (auto const& item : sheet.items) {
    auto const& picture = pictures.emplace_back(std::make_unique<Bitmap>(item.picture.c_str()));
    check(picture->GetLastStatus(), item.picture.string());
    sizes.push_back(
        {static_cast<int>(picture->GetWidth()), static_cast<int>(picture->GetHeight())});
    captions.add(item.caption);
  }
  SheetLayout const layout(sizes, SheetLayout::max_columns, captions, sheet.scale);
  Picture on(name, layout.sheet_width(), layout.sheet_height());
  on.fill(0, 0, layout.sheet_width(), layout.sheet_height(), {0xff, 0xff, 0xff});
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    std::istringstream caption(sheet.items[i].caption);
    int number = 0;
    for (std::string line; std::getline(caption, line); ++number) {
      on.write({layout.left(i) + layout.cell_width / 2, layout.line_middle(i, number), layout.text,
                LabelAlign::centre, line});
    }
    on.paste(*pictures[i], layout.picture_left(i, sizes[i].width),
             layout.picture_top(i, sizes[i].height));
  }
  if (sheet.scale) add_scale(on, layout);
  return on.encode();
}

bool is_animation(std::filesystem::path const& /*path*/) { return false; }

}  // namespace gpu_shading::energyplus
