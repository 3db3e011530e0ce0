// ribvault_steps: what the figures draw, as JSON. Usage: ribvault_steps layers|stages|tree MODEL -o FILE [options]
#include <CLI/CLI.hpp>
#include <iostream>

#include "commands.hpp"
#include "ribvault/error.hpp"
#include "ribvault/output_file.hpp"

namespace {

using namespace ribvault;
using namespace ribvault::steps;

CLI::App* add_command(CLI::App& app, const char* name, const char* help, Options& o) {
    CLI::App* command = app.add_subcommand(name, help);
    command->add_option("model", o.model)->required();
    command->add_option("-o", o.output, "JSON file to write")->required();
    command->add_option("--scale", o.scale), command->add_option("--height", o.height),
        command->add_option("--bed", o.bed);
    command->add_option("--up", o.up)->check(CLI::IsMember({"x", "y", "z"}));
    command->add_option("--layer-height", o.layer_height);
    command->add_option("--top-layers", o.top_layers), command->add_option("--bottom-layers", o.bottom_layers);
    command->add_option("--gaps", o.gaps)->check(CLI::IsMember({"proved", "paper", "none"}));
    command->add_flag("--no-straighten", o.no_straighten), command->add_flag("--no-branch-bonus", o.no_branch_bonus);
    command->add_option("--seed", o.seed);
    return command;
}

void write(const Json& result, const std::string& file) {
    AtomicFile out(file);
    out.write(result.dump() + "\n");
    out.commit();
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"The vault's stages one by one, as JSON for the figures"};
    app.require_subcommand(1);
    Options o;
    int from = 0, to = -1, layer = -1, branches = 7;
    CLI::App* all = add_command(app, "layers", "slices, supports and paths of a run", o);
    all->add_option("--from", from, "lowest layer (default 0)"),
        all->add_option("--to", to, "highest layer (default: the top)");
    CLI::App* one = add_command(app, "stages", "from one layer to the next, stage by stage", o);
    one->add_option("--layer", layer, "the lower layer (default: where Copy clips and prolongs most)");
    CLI::App* tree_command = add_command(app, "tree", "straightening and printing of one tree", o);
    tree_command->add_option("--layer", layer)->required();
    tree_command->add_option("--branches", branches, "how many the tree should have (default 7)");
    CLI11_PARSE(app, argc, argv);
    try {
        write(*all ? layers(o, from, to) : *one ? stages(o, layer) : tree(o, layer, branches), o.output);
    } catch (const Error& e) {
        std::cerr << "ribvault_steps: " << e.what() << "\n";
        return static_cast<int>(e.kind());
    }
    return 0;
}
