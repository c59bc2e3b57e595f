# SPDX-License-Identifier: MIT
# Writes OUTPUT, a .cpp with the bytes of FILES, which ltc::viewer_file (src/report/viewer_files.h)
# finds by their names without folders.
cmake_minimum_required(VERSION 3.25)
set(arrays "")
set(names "")
set(number 0)
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME)
  file(READ ${file} hex HEX)
  string(LENGTH "${hex}" digits)
  math(EXPR size "${digits} / 2")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
  string(REGEX REPLACE "(....................................................................................................)" "\\1\n" bytes "${bytes}")  # 20 a line
  string(APPEND arrays "constexpr unsigned char file_${number}[] = {\n${bytes}0};\n")
  string(APPEND names "    {\"${name}\", file_${number}, ${size}},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE ${OUTPUT}.new
"// Made by cmake/embed.cmake.
#include \"report/viewer_files.h\"

#include \"core/error.h\"

namespace ltc {
namespace {

${arrays}
struct Embedded {
  std::string_view name;
  const unsigned char* bytes;
  std::size_t size;
};
constexpr Embedded all[] = {
${names}};

}  // namespace

std::string_view viewer_file(std::string_view name) {
  for (const Embedded& file : all)
    if (file.name == name)
      return {reinterpret_cast<const char*>(file.bytes), file.size};
  throw InputError(\"the viewer has no file \" + std::string(name));
}

}  // namespace ltc
")
file(COPY_FILE ${OUTPUT}.new ${OUTPUT} ONLY_IF_DIFFERENT)
file(TOUCH ${OUTPUT})
file(REMOVE ${OUTPUT}.new)
