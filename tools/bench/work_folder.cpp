#include "bench/work_folder.h"

#include "bench/sequence_json.h"
#include "core/error.h"
#include "core/log.h"
#include "image_io/file.h"
#include "image_io/image_io.h"

namespace tarn {

namespace {

constexpr const char* KEY_NOTE = "run";
// CBOR: unlike JSON it keeps infinities.
constexpr const char* NOTE_ENDING = ".cbor";

void warn_damaged(const std::filesystem::path& file) {
    warn_once(fmt::format("{}: damaged, measured again", file.string()));
}

}  // namespace

WorkFolder::WorkFolder(std::filesystem::path folder, const nlohmann::json& key) : folder_(std::move(folder)) {
    create_folder(folder_);
    const nlohmann::json old_key = load_note(KEY_NOTE);
    if (old_key.is_null()) {
        save_note(KEY_NOTE, key);
        return;
    }
    if (old_key != key) {
        throw Error(
            "{}: belongs to an unfinished run with other settings; remove it or choose another folder",
            folder_.string());
    }
    resumed_ = true;
}

std::filesystem::path WorkFolder::file(const std::string& name, const char* ending) const {
    return folder_ / (name + ending);
}

void WorkFolder::save(const std::string& name, const MeasuredSequence& sequence) const {
    write_exr(file(name, ".mean.exr"), sequence.mean);
    write_exr(file(name, ".first.exr"), sequence.first);
    // Last, so that where there is a measure there are its pictures.
    save_note(name, sequence.measure);
}

std::optional<SequenceMeasure> WorkFolder::load_measure(const std::string& name) const {
    const nlohmann::json note = load_note(name);
    if (note.is_null()) return std::nullopt;
    try {
        load_mean(name);
        load_first(name);
        return note.get<SequenceMeasure>();
    } catch (const std::exception&) {
        warn_damaged(file(name, NOTE_ENDING));
        return std::nullopt;
    }
}

Image WorkFolder::load_mean(const std::string& name) const {
    return read_radiance(file(name, ".mean.exr"));
}

Image WorkFolder::load_first(const std::string& name) const {
    return read_radiance(file(name, ".first.exr"));
}

void WorkFolder::save_note(const std::string& name, const nlohmann::json& note) const {
    const std::vector<std::uint8_t> bytes = nlohmann::json::to_cbor(note);
    write_file(file(name, NOTE_ENDING), {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

nlohmann::json WorkFolder::load_note(const std::string& name) const {
    if (!std::filesystem::exists(file(name, NOTE_ENDING))) return nullptr;
    nlohmann::json note = nlohmann::json::from_cbor(load_file(file(name, NOTE_ENDING)), true, false);
    if (!note.is_discarded()) return note;
    warn_damaged(file(name, NOTE_ENDING));
    return nullptr;
}

void WorkFolder::remove() const {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

}  // namespace tarn
