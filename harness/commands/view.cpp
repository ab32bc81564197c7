// SPDX-License-Identifier: MIT
#include "harness/measure/view.h"

#include <iostream>

#include "harness/choice/choices.h"
#include "harness/commands/command.h"
#include "harness/commands/words.h"

namespace bvhbench {
namespace {

/// For `report`, which is written in Python.
class ViewCommand final : public Command {
public:
    void add_options(CLI::App& app) override
    {
        app.add_option("--scene", scene_)->required();
        app.add_option("--frame", frame_);
        app.add_option("--builder", choice_.builder.name);
        app.add_option("--collider", choice_.collider.name);
        add_choices(app, choice_,
                    [](const Choice& option) { return option.of == Choice::Of::builder; });
    }

    int run(const Invocation& invocation) override
    {
        check_choice(choice_);
        check_powers(choice_);
        Session session(invocation.common);
        std::cout << view_text(view_of(
            session,
            {.scene = scene_, .frame = frame_, .pipeline = {choice_.builder, choice_.collider}},
            invocation.words));
        return 0;
    }

private:
    std::string scene_;
    unsigned frame_ = 0;
    CellChoice choice_{.builder = {.name = "oibvh-multi"},
                       .collider = {.name = "leaf", .keep_adjacent = false, .narrow = "exact"}};
};

}  // namespace

extern const CommandEntry view_command = {
    "view",
    {},
    "A frame with a builder's boxes and a collider's pairs, as JSON",
    {},
    {},
    {},
    make_command<ViewCommand>};

}  // namespace bvhbench
