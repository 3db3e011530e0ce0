// How far the sweep is: one line that renews itself on a terminal, a plain line every tenth of the way otherwise.
#pragma once

namespace ribvault::cli {

class Progress {
public:
    explicit Progress(bool quiet);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void operator()(int done, int total);

private:
    bool quiet_, terminal_;
    int shown_ = -1;
};

}  // namespace ribvault::cli
