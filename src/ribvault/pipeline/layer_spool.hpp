// What is made of the layers in one order and needed in another, kept on disk so that memory does not grow.
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ribvault {

class LayerSpool {
public:
    /// Opens a nameless temporary file. Throws Error (cannot_write) when there is no place for one.
    LayerSpool();
    /// Throws Error (cannot_write) when the disk is full.
    void add(std::string_view text);
    /// Hands out the texts, the last one first.
    void replay_backwards(const std::function<void(std::string_view)>& take);
    /// The k-th text that was added, once finish() was called. May be called from several threads at once.
    std::string at(std::size_t k) const;
    /// After this nothing is added. Throws Error (cannot_write) when the disk is full.
    void finish();

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::unique_ptr<std::FILE, Close> file_;
    std::vector<std::uint64_t> ends_;
};

}  // namespace ribvault
