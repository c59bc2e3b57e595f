// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// ltcfit prefilter: the image of a light as the texture that shaders fetch.
#include <fmt/format.h>

#include <bit>
#include <memory>

#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "core/parallel.h"
#include "render/light_texture.h"
#include "render/light_texture_file.h"

namespace ltc::cli {
namespace {

struct Arguments {
  std::string image, output;
  std::size_t side = 0;  // 0: by the image
  bool zstd = true;
  int threads = processor_count();
};

void prefilter(const Arguments& arguments) {
  ProgressDisplay progress;
  const StopOnInterrupt stop_on_interrupt(progress);
  const LightImage image = read_light_image(arguments.image);
  const std::size_t side = arguments.side ? arguments.side : usual_light_texture_side(image);
  const std::vector<Image> levels =
      ltc::prefilter(image, side, "prefilter", {arguments.threads, &progress});
  // The last chance to stop.
  progress.throw_if_stopped();
  write_light_texture(levels, arguments.output, arguments.zstd);
  print(fmt::format("wrote {}\n", one_line(arguments.output)));
}

Allowed power_of_two(std::size_t least, std::size_t most) {
  const Allowed whole = whole_number(static_cast<double>(least), static_cast<double>(most));
  return {fmt::format("a power of two in [{}, {}]", least, most), [whole](std::string& text) {
            return whole.take(text) && std::has_single_bit(std::stoull(text));
          }};
}

}  // namespace

Action declare_prefilter(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  add_image_argument(app, "IMAGE", arguments->image,
                     "image of a rectangular light, PNG (sRGB) or OpenEXR (linear)");
  allow(add_output_option(app, "-o,--output", arguments->output,
                          "the texture with all its levels, .ktx2 or .exr"),
        {"a file that ends in .ktx2 or .exr",
         [](std::string& file) { return is_light_texture_file(file); }})
      ->required()
      ->group("What to write");
  allow(app.add_option("--size", arguments->side,
                       "texels a side, a power of two [512, or what holds the image]"),
        power_of_two(least_light_texture_side, largest_light_texture_side))
      ->option_text("N")
      ->group("What to write");
  app.add_flag_function(
         "--no-zstd", [arguments](std::int64_t) { arguments->zstd = false; },
         "leave KTX2 uncompressed")
      ->group("What to write");
  add_threads_option(app, arguments->threads);
  return [arguments](Files&) { prefilter(*arguments); };
}

}  // namespace ltc::cli
