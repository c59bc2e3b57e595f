// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// How the values of a table lie in the textures that engines take, whatever the container
// (docs/files.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/output_settings.h"
#include "export/image.h"
#include "table/table.h"

namespace ltc {

// Which layout `automatic` is for such a table, the first that can hold it; any other is itself.
TextureLayout resolved(TextureLayout layout, const Grid& grid, Storage storage);

// How many images it has.
std::size_t image_count(TextureLayout layout);

// Why it cannot hold tables of this grid and storage, after "it"; empty where it can.
std::string why_not(TextureLayout layout, const Grid& grid, Storage storage);

// The table's values, those of skipped entries by nearest_fitted (export/nearest.h). Not
// `automatic`, and only where why_not has nothing against it.
std::vector<Image> images_of(const Table& table, TextureLayout layout);

// The table of images of a layout, or of the one that they look like: by their number and shape,
// and of two that look alike that whose lobes are where a mirror would have them. Amplitude and
// Fresnel terms that the images lack are NaN; Table::read_as says what was taken and why. Throws
// InputError, naming `file`, for images of no layout or not of the one asked for, and values that
// are not finite. Images of a `model` whose lobes are not about the mirror direction are taken for
// the first layout of their shape.
Table table_of(const std::vector<Image>& images, TextureLayout layout,
               const std::filesystem::path& file, const LobeModel* model = nullptr);

}  // namespace ltc
