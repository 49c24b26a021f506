// What a flight becomes: results.json for the page, a summary for the terminal, a video.
#pragma once

#include <nlohmann/json.hpp>

#include "flythrough_run.h"

namespace tarn {

// The "flythroughs" entry of results.json.
nlohmann::ordered_json describe_flight(const FlightPlan& plan, const Flight& flight, const std::string& scene,
                                       const std::string& path_name);

void print_flight(const FlightPlan& plan, const Flight& flight);

// Makes flythrough.mp4 of the first method's pictures where ffmpeg is installed and there are enough of them;
// a warning where ffmpeg fails.
void write_video(const FlightPlan& plan, const Flight& flight, const std::filesystem::path& out,
                 double duration_s);

}  // namespace tarn
