// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// A picture of a function of four indices: rows and columns of tiles, each a small heat map.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "picture/canvas.h"
#include "picture/text.h"

namespace ltc::picture {

// One of the four directions of a tiled map.
struct MapAxis {
  std::size_t size = 0;  // number of cells or tiles
  std::string title{};   // "α", "θ"
  std::vector<std::string>
      labels{};  // one for each index, or none; within tiles the ends are shown
};

struct CellMark {
  std::array<std::size_t, 4> index;  // tile row, tile column, row, column
  std::string label{};               // written near the cell
};

struct TiledMap {
  Words words{};
  MapAxis tile_rows{};     // from the top
  MapAxis tile_columns{};  // from the left
  MapAxis rows{};          // within a tile, from the top
  MapAxis columns{};       // within a tile, from the left
  // tile_rows x tile_columns x rows x columns values, the last index running fastest (the order of
  // a table over alpha, lambda, theta, phi). NaN cells are hatched.
  std::vector<float> values{};
  ColorScale colors;
  std::vector<CellMark> marks{};  // ringed
  double font_size = 20;          // pixels
};

// Ratios around 1 from 1/largest to `largest` (> 1), logarithmic and diverging: white is 1.
ColorScale ratio_colors(double largest, std::string title);

// Where things stand in the picture of a map, in pixels.
struct TiledMapLayout {
  int width = 0, height = 0;  // of the picture
  double cell = 0;            // side of a cell
  double gap = 0;             // between tiles
  Box map;                    // all tiles
  Box bar;                    // the colour bar with its words
  Box key;                    // the explanation of what is within a tile

  std::array<std::size_t, 4> sizes{};
  Box tile_box(std::size_t tile_row, std::size_t tile_column) const;
  Box cell_box(const std::array<std::size_t, 4>& index) const;
};

// The layout, from the sizes: cells are squares of 2 to 40 pixels, such that the map is about 880
// pixels high or wide where that is possible. Throws InputError if a size is 0, if the number of
// values or labels does not fit the sizes, or if a mark lies outside.
TiledMapLayout lay_out(const TiledMap& map);

Canvas render(const TiledMap& map);

}  // namespace ltc::picture
