#include "ribvault/pipeline/picture_folder.hpp"

#include <cstdio>
#include <regex>
#include <set>

#include "ribvault/error.hpp"

namespace ribvault {

namespace fs = std::filesystem;

bool is_picture_name(const std::string& name) {
    static const std::regex ours("layer_[0-9]{5,}(_[0-9]+um)?\\.svg");
    return std::regex_match(name, ours);
}

PictureFolder::PictureFolder(fs::path folder) : folder_(std::move(folder)) {
    std::error_code error;
    for (fs::path p = folder_.lexically_normal(); !p.empty() && !fs::exists(p, error); p = p.parent_path()) {
        made_ = p;
        if (p == p.parent_path()) break;
    }
    fs::create_directories(folder_, error);
    if (error)
        throw Error(ErrorKind::cannot_write, folder_.string() + ": cannot make this folder (" + error.message() +
                                                 "); choose another with --svg");
}

PictureFolder::~PictureFolder() {
    if (committed_ || made_.empty()) return;
    std::error_code error;
    for (fs::path p = folder_.lexically_normal(); fs::remove(p, error) && p != made_; p = p.parent_path()) {}
}

AtomicFile PictureFolder::picture(int layer, const std::string& part) const {
    char name[64];
    std::snprintf(name, sizeof name, "layer_%05d%s%.20s.svg", layer, part.empty() ? "" : "_", part.c_str());
    return AtomicFile(folder_ / name, false);
}

void PictureFolder::commit(std::vector<AtomicFile>& pictures) {
    committed_ = true;
    std::set<fs::path> names;
    for (AtomicFile& picture : pictures) names.insert(picture.target().filename()), picture.commit();
    std::vector<fs::path> earlier;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error))
        if (is_picture_name(entry.path().filename().string()) && !names.contains(entry.path().filename()))
            earlier.push_back(entry.path());
    for (const fs::path& picture : earlier) fs::remove(picture, error);
}

}  // namespace ribvault
