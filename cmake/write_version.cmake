# Writes OUTPUT, the source of tarn_version. cmake -DOUTPUT=... -DVERSION=... -DBUILD_TYPE=... -DGIT=... -DSOURCE=... -P
set(COMMIT "")
if(GIT)
  execute_process(COMMAND ${GIT} rev-parse --short=12 HEAD WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE COMMIT
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(NOT COMMIT)
  set(COMMIT unknown)
endif()
file(WRITE ${OUTPUT} "// Written by the build: see cmake/write_version.cmake.
#include \"core/version.h\"

namespace tarn {

const char* const VERSION = \"${VERSION}\";
const char* const COMMIT = \"${COMMIT}\";
const char* const BUILD_TYPE = \"${BUILD_TYPE}\";

}  // namespace tarn
")
