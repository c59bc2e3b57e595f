// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Fields as functions in shading languages and JavaScript, and what shaders are told of tables,
// each a format that is only written.
#include "core/write_file.h"
#include "export/field_code.h"
#include "export/format.h"
#include "export/table_code.h"

namespace ltc {

Format field_function_format(const char* ending, CodeLanguage language) {
  return {.name = std::string(name_of(language)) + " code",
          .sets = {{ending}},
          .asked = &OutputSettings::shaders,
          .contents = {.albedo = true, .loss = false},
          .of_fields = language == CodeLanguage::javascript,
          .of_materials = true,
          .of_folded = true,
          .of_one_pair = true,
          .ending_of_others = true,
          .add = [language](platform::FileSet& set, const Table& table, const TableFiles& files,
                            const WriteOptions&) {
            add_file(set, files.front(),
                     table.field
                         ? field_function(*table.field, language)
                         : table_constant(table.grid, table.storage, language, table.creases));
          }};
}

}  // namespace ltc
