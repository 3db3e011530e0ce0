// The folder that --svg names: pictures of layers, all of one run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ribvault/output_file.hpp"

namespace ribvault {

/// Is this the name of a picture that a run leaves in its folder?
bool is_picture_name(const std::string& name);

class PictureFolder {
public:
    /// Makes the folder. Throws Error (cannot_write) when that cannot be.
    explicit PictureFolder(std::filesystem::path folder);
    /// Without commit() a folder that was made and is empty goes again.
    ~PictureFolder();
    PictureFolder(const PictureFolder&) = delete;
    PictureFolder& operator=(const PictureFolder&) = delete;

    /// A picture of a layer, not yet under its name; `part` tells several of one layer apart. May be called from
    /// several threads at once.
    AtomicFile picture(int layer, const std::string& part = {}) const;

    /// Puts the pictures, which picture() made, under their names and removes those of earlier runs.
    void commit(std::vector<AtomicFile>& pictures);

private:
    std::filesystem::path folder_, made_;  ///< made_: the uppermost folder that was not there before
    bool committed_ = false;
};

}  // namespace ribvault
