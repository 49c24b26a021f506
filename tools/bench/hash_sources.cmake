# Writes the header OUTPUT with one hash over the files FILES (separated by "|"): a version that no one can forget to
# raise. cmake -DOUTPUT=... -DFILES=... -P hash_sources.cmake
string(REPLACE "|" ";" FILES "${FILES}")
set(HASHES "")
foreach(FILE ${FILES})
  file(SHA256 ${FILE} HASH)
  string(APPEND HASHES ${HASH})
endforeach()
string(SHA256 VERSION "${HASHES}")
string(SUBSTRING ${VERSION} 0 16 VERSION)
file(WRITE ${OUTPUT} "// Made by the build: a hash over all code that decides a reference's bits.
#pragma once

namespace tarn {

inline constexpr const char* REFERENCE_VERSION = \"${VERSION}\";

}  // namespace tarn
")
