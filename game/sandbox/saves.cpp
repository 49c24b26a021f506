#include "saves.h"

#include <fmt/format.h>

#include "../play/save_file.h"
#include "../user_folders.h"

namespace game {

Saves::Saves(const std::filesystem::path& folder, const std::string& scene, std::uint64_t level_hash)
    : folder_(folder), scene_(scene), level_hash_(level_hash) {}

std::filesystem::path Saves::file(SaveKind kind) const {
    const std::string name = std::filesystem::path(scene_).stem().string();
    return folder_ /
           fmt::format("{}-{:016x}.{}", name, level_hash_, kind == SaveKind::AUTOMATIC ? "autosave" : "save");
}

void Saves::write(SaveKind kind, const Stage& stage) const {
    write_whole(file(kind), describe_save({scene_, level_hash_, stage.save()}));
}

bool Saves::load(SaveKind kind, Stage& stage) const {
    const std::filesystem::path from = file(kind);
    if (!std::filesystem::exists(from)) return false;
    try {
        const SaveFile save = load_save(from);
        if (save.level_hash != level_hash_) {
            throw Error(fmt::format("{}: saved in '{}' (level {:016x}), this is '{}' (level {:016x})",
                                    from.string(), save.scene, save.level_hash, scene_, level_hash_));
        }
        stage.load(save.play);
    } catch (const Error& error) {
        throw Error(
            fmt::format("{}; kept as {}", error.what(), put_aside(from, "damaged").filename().string()));
    }
    return true;
}

}  // namespace game
