// How far the sweep is: one line that renews itself on a terminal, a plain line every tenth of the way otherwise.
#pragma once

namespace ribvault::cli {

class Progress {
public:
    /// `order` follows the count where there is no terminal.
    explicit Progress(bool quiet, const char* order = ", from the top");
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void operator()(int done, int total);
    /// Takes the line off the terminal, before something else is printed.
    void clear();

private:
    bool quiet_, terminal_;
    const char* order_;
    int shown_ = -1;
};

}  // namespace ribvault::cli
