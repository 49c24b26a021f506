// The methods that the benchmark compares: names for settings of the renderer, registered once.
#pragma once

#include <string>
#include <vector>

#include "settings/settings.h"

namespace tarn {

struct Method {
    std::string label;     // as the user gave it: "ris:candidates=8"; unique within a run
    std::string sentence;  // what it is
    RenderSettings settings;
    std::string dial;        // the setting that more time is spent on; empty: more frames are averaged
    int warm_up_frames = 0;  // before a sequence counts: what its history needs to fill
};

// All registered methods with their default settings, in the order in which reports show them.
const std::vector<Method>& method_table();

// Reads NAME[:setting=value[,setting=value...]] with the renderer's own settings table. A dial that is given
// a value is not turned any more: `samples` takes its place where the method takes several, else nothing.
// Throws Error that names what is unknown and what there is.
Method parse_method(const std::string& text);

// Reads methods separated by commas; a piece such as "candidates=8" belongs to the method before it. Throws
// Error as parse_method does, and where a method is named twice or none is.
std::vector<Method> parse_methods(const std::string& text);

// Bounces of the reference that these methods are measured against: 1, and those of their indirect light.
// Throws Error where they do not agree, since the same reference cannot judge them all.
int count_bounces(const std::vector<Method>& methods);

// Whether any of them shows the mean over each pixel, so that the reference has to: else it sees pixels'
// centres.
bool any_antialiases(const std::vector<Method>& methods);

// The row of the settings table with this name. Throws Error that lists the names.
const Setting& find_setting(const std::string& name);

}  // namespace tarn
