// Which Tarn was linked.
#pragma once

#include <string>

namespace tarn::api {

// "tarn 0.1.0 (commit 0123456789ab, RelWithDebInfo)". The commit is "unknown" where the sources came without
// git. Files of Picture::write_exr have it as their attribute "software".
std::string describe_version();

}  // namespace tarn::api
