// Methods and their limits in the window, chosen and read by the test engine.
#include <imgui.h>
#include <imgui_internal.h>

#include <catch2/catch_test_macros.hpp>
#include <string>
#include <string_view>

#include "lab_driver.h"
#include "scene/fields.h"
#include "sim/integrators/integrator.h"

namespace clothlab::test {
namespace {

sim::IntegratorId integrator(std::string_view name) {
    for (const sim::IntegratorInfo& i : sim::integrators())
        if (i.name == name)
            return i.id;
    FAIL("no integrator " << name);
    return {};
}

/// Opens the list of a parameter and clicks an entry. ImGui does not tell the test engine the labels of lists, so the
/// path has to be whole.
void choose(ImGuiTestContext* user, std::string_view group, std::string_view key, std::string_view entry) {
    user->ItemClick(("###Parameters/" + std::string(group) + "##fields/" + std::string(key) + "/##value").c_str());
    const ImGuiWindow* list = user->GetWindowByRef("//$FOCUSED");
    user->ItemClick(("//" + std::string(list->Name) + "/**/" + std::string(entry)).c_str());
}

void choose_method(ImGuiTestContext* user, std::string_view name) {
    choose(user, "method", "simulation.integrator", sim::traits(integrator(name)).title);
}

bool shown(LabDriver& driver, const char* item) {
    bool found = false;
    REQUIRE(driver.act([&](ImGuiTestContext* user) {
        found = user->ItemExists(("###Parameters/**/" + std::string(item) + "/##value").c_str());
    }));
    return found;
}

} // namespace

TEST_CASE("Every method can be chosen in the list while the cloth moves, and goes on from where it is") {
    LabDriver driver("two-pins");
    driver.app().simulation().step_frames(5);
    driver.settle();
    for (const sim::IntegratorInfo& i : sim::integrators()) {
        INFO(i.name);
        const std::uint64_t steps = driver.lab().snapshot->steps;
        REQUIRE(driver.act([&](ImGuiTestContext* user) { choose_method(user, i.name); }));
        CHECK(driver.lab().scene.simulation.stepping.integrator == i.id);
        CHECK(driver.lab().snapshot->steps == steps);
        REQUIRE(driver.act([](ImGuiTestContext* user) { user->KeyPress(ImGuiMod_Shift | ImGuiKey_N); }));
        CHECK(driver.lab().snapshot->steps == steps + 1);
        CHECK(driver.lab().snapshot->diagnostics.status == sim::Status::ok);
    }
    CHECK(driver.lab().messages.empty());
}

TEST_CASE("A method shows the parameters that it has and no others") {
    LabDriver driver("two-pins");
    const auto take = [&](const char* name) {
        REQUIRE(driver.act([&](ImGuiTestContext* user) { choose_method(user, name); }));
    };
    CHECK_FALSE(shown(driver, "simulation.iterations"));
    take("pbd");
    CHECK(shown(driver, "simulation.iterations"));
    CHECK(shown(driver, "simulation.pbd_stiffness"));
    CHECK_FALSE(shown(driver, "simulation.tolerance"));
    take("backward-euler");
    CHECK(shown(driver, "simulation.tolerance"));
    CHECK_FALSE(shown(driver, "simulation.iterations"));
}

TEST_CASE("Every value of every rule can be chosen in its list, and is shown in words of its file") {
    LabDriver driver("two-pins");
    REQUIRE(driver.act([](ImGuiTestContext* user) { user->ItemClick("###Parameters/Rules"); }));
    for (const scene::Field& f : scene::fields()) {
        if (f.section() != "rules")
            continue;
        for (std::size_t i = f.choices.size(); i-- > 0;) {
            INFO(f.key << " = " << f.choices[i]);
            REQUIRE(driver.act([&](ImGuiTestContext* user) { choose(user, "rules", f.key, f.choices[i]); }));
            CHECK(f.get(driver.lab().scene) == static_cast<double>(i));
        }
    }
    CHECK(driver.lab().messages.empty());
}

TEST_CASE("The stability panel measures the state shown, and a hidden one measures nothing") {
    LabDriver driver("two-pins");
    const auto margin = [&] { return driver.lab().snapshot->stability; };
    driver.settle();
    REQUIRE(margin().has_value());
    CHECK(margin()->limit > 1.9);
    CHECK(margin()->stable());
    REQUIRE(driver.act(
        [](ImGuiTestContext* user) { user->ItemInputValue("###Parameters/**/cloth.ks/##value", "300000"); }));
    driver.settle();
    REQUIRE(margin().has_value());
    CHECK_FALSE(margin()->stable());
    CHECK(margin()->ks_max < 300000);

    REQUIRE(driver.act([](ImGuiTestContext* user) { user->WindowClose("###Stability"); }));
    driver.app().simulation().step(1);
    driver.settle();
    CHECK_FALSE(margin().has_value());
}

TEST_CASE("Playing stops at a jitter where that is asked for") {
    LabDriver driver("two-pins");
    REQUIRE(driver.act([](ImGuiTestContext* user) {
        user->ItemInputValue("###Parameters/**/cloth.ks/##value", "300000");
        user->ItemClick("###Stability/jitter");
    }));
    driver.app().simulation().play(true);
    for (int i = 0; i < 100 && !driver.lab().playing; ++i)
        driver.frame();
    for (int i = 0; i < 5000 && driver.lab().playing; ++i)
        driver.frame();
    CHECK_FALSE(driver.lab().playing);
    REQUIRE(driver.lab().snapshot->trouble.has_value());
    CHECK(driver.lab().snapshot->trouble->status == sim::Status::jitter);
    REQUIRE(driver.lab().messages.size() == 1);
    CHECK(driver.lab().messages.front().text.find("jitters") != std::string::npos);
}

} // namespace clothlab::test
