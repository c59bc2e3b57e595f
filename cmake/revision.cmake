# SPDX-License-Identifier: MIT
# Writes OUTPUT with the program's version and git commit, only when they changed.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit "unknown")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT
"#pragma once
#define LTCFIT_VERSION \"${VERSION}\"
#define LTCFIT_COMMIT \"${commit}\"
")
