// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What fit --as-in tells of the lobe that a table holds: text, JSON, the words of its picture.
#pragma once

#include <string>

#include "export/format.h"
#include "picture/text.h"
#include "pipeline/stored_lobe.h"

namespace ltc::cli {

struct StoredReport {
  std::string file;
  TableContents contents;  // what such a file holds
  Table table;
  StoredLobe lobe;
};

std::string report_text(const StoredReport& report);
std::string report_json(const StoredReport& report);  // with a line break at its end

picture::Words picture_words(const StoredReport& report);

}  // namespace ltc::cli
