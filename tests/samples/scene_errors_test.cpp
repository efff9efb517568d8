#include <gtest/gtest.h>
#include <swept/samples/scene_reader.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

/// Every way in which a scene can be wrong: the pointer of the culprit and the reason, in words a user understands.

namespace swept {
namespace {

struct Case {
    std::string text;
    std::string pointer;
    std::string reason;  ///< must occur in the reason
};

// A case is named by its own text, so a failure shows it; `body` and the like build the scene around the fault.
std::string ball(const std::string& members) {
    return R"({"bodies": [{"type": "dynamic", "shapes": [{"circle": {"radius": 1}}], )" + members + "}]}";
}
std::string wall(const std::string& members) { return R"({"bodies": [{)" + members + "}]}"; }
std::string shape(const std::string& members) { return R"({"bodies": [{"shapes": [{)" + members + "}]}]}"; }
std::string settings(const std::string& members) { return R"({"settings": {)" + members + R"(}, "bodies": []})"; }
std::string joint(const std::string& members) {
    return R"({"bodies": [{"name": "floor"}, {"name": "wall"}, {"name": "ball", "type": "dynamic", "shapes": [{"circle":
              {"radius": 1}}]}, {"type": "dynamic", "mass": 1, "inertia": 2}], "joints": [{)" +
           members + "}]}";
}
const std::string kHinge = R"("type": "revolute", "bodyA": "floor", "bodyB": "ball", "anchor": [0, 1])";
const std::string kRodFrom = R"("type": "distance", "bodyA": "floor", "bodyB": "ball", "anchorB": [0, 1], "anchorA": )";
const std::string kRod = kRodFrom + "[0, 5]";

void expectErrors(const std::vector<Case>& cases) {
    for (const Case& c : cases) {
        const SceneResult result = readScene(c.text, "my.json");
        EXPECT_FALSE(result.scene.has_value()) << c.text;
        EXPECT_EQ(result.error.pointer, c.pointer) << c.text << "\n  " << result.error.text();
        EXPECT_NE(result.error.reason.find(c.reason), std::string::npos) << c.text << "\n  " << result.error.text();
        const std::string where = c.pointer.empty() ? "" : c.pointer + ": ";
        EXPECT_EQ(result.error.text(), "my.json: " + where + result.error.reason);
    }
}

TEST(SceneErrors, Syntax) {
    expectErrors({
        {"", "line 1, column 1", "no JSON value"},
        {" \n ", "line 1, column 1", "no JSON value"},
        {"{", "line 1, column 2", "unexpected end of input"},
        {"{\"bodies\": []", "line 1, column 14", "unexpected end of input"},
        {"{\"bodies\": []\n,}", "line 2, column 1", "trailing comma"},
        {"{\n \"bodies\":\n  [1 2]}", "line 3, column 6", "a comma is missing before 2"},
        {"{\"bodies\": [NaN]}", "line 1, column 13", "NaN is no JSON number"},
        {"{\"bodies\": [Infinity]}", "line 1, column 13", "Infinity is no JSON number"},
        {"{\"bodies\": [01]}", "line 1, column 14", "expected ']'"},
        {"{\"bodies\": [.5]}", "line 1, column 13", "invalid literal"},
        {"{\"bodies\": []} // end", "line 1, column 16", "no comments"},
        {"{'bodies': []}", "line 1, column 2", "double quotes"},
        {"{\"bodies\": []}{}", "line 1, column 15", "expected end of input"},
        {"{\"name\": \"\xc3\xa4\xc3\xb6\", x}", "line 1, column 16", "invalid literal"},  // columns are characters
        {"{\"name\": \"\xff\", \"bodies\": []}", "line 1, column 11", "ill-formed UTF-8"},
        {"{\"name\": \"a\nb\", \"bodies\": []}", "line 1, column 12", "control character"},
    });
}

TEST(SceneErrors, DuplicateKeysOverflowAndDepth) {
    const std::string deep = std::string(65, '[') + std::string(65, ']');
    std::string deepPointer;
    for (int i = 0; i < 64; ++i) { deepPointer += "/0"; }
    expectErrors({
        {R"({"bodies": [], "name": "a", "bodies": []})", "/bodies", "twice"},
        {ball(R"("angle": 0, "angle": 0)"), "/bodies/0/angle", "twice"},
        {R"({"bodies": [{"shapes": [{"box": {"half": [1, 1], "half": [1, 1]}}]}]})", "/bodies/0/shapes/0/box/half",
         "twice"},
        {R"({"a/b~c": 1, "a/b~c": 1})", "/a~1b~0c", "twice"},
        {R"({"gravity": [0, -1e999], "bodies": []})", "/gravity/1", "-1e999 overflows"},
        {settings(R"("dt": 1e400)"), "/settings/dt", "1e400 overflows"},
        {"1e999", "", "overflows"},
        {deep, deepPointer, "nested deeper than 64"},
    });
}

TEST(SceneErrors, UnknownKeys) {
    expectErrors({
        {R"({"bodeis": []})", "/bodeis", "did you mean \"bodies\"?"},
        {R"({"bodies": [], "colour": 1})", "/colour", "known here: name, gravity, view, settings, bodies, joints"},
        {R"({"bodies": [], "a/b": 1})", "/a~1b", "unknown key \"a/b\""},
        {R"({"bodies": [{"restitution": 1}]})", "/bodies/0/restitution", "\"restitution\"; it belongs to shapes"},
        {R"({"bodies": [{"shapes": [{"circle": {"radius": 1}, "mass": 1}]}]})", "/bodies/0/shapes/0/mass",
         "unknown key \"mass\"; it belongs to bodies"},
        {R"({"bodies": [], "dt": 1})", "/dt", "unknown key \"dt\"; it belongs to \"settings\""},
        {R"({"bodies": [], "settings": {"gravity": [0, 0]}})", "/settings/gravity",
         "unknown key \"gravity\"; it belongs to the scene itself"},
        {R"({"bodies": [{"bodis": 1}]})", "/bodies/0/bodis", "unknown key \"bodis\"; known here: name,"},
        {ball(R"("postion": [0, 0])"), "/bodies/0/postion", "did you mean \"position\"?"},
        {ball(R"("Position": [0, 0])"), "/bodies/0/Position", "did you mean \"position\"?"},
        {ball(R"("linear_damping": 0)"), "/bodies/0/linear_damping", "did you mean \"linearDamping\"?"},
        {shape(R"("box": {"half": [1, 1]}, "frcition": 1)"), "/bodies/0/shapes/0/frcition", "\"friction\"?"},
        {shape(R"("box": {"half": [1, 1]}, "frictionMixng": "minimum")"), "/bodies/0/shapes/0/frictionMixng",
         "\"frictionMixing\"?"},
        {shape(R"("box": {"half": [1, 1]}, "restitutionmixing": "minimum")"), "/bodies/0/shapes/0/restitutionmixing",
         "\"restitutionMixing\"?"},
        {shape(R"("bx": {"half": [1, 1]})"), "/bodies/0/shapes/0/bx", "did you mean \"box\"?"},
        {shape(R"("box": {"hlaf": [1, 1]})"), "/bodies/0/shapes/0/box/hlaf", "did you mean \"half\"?"},
        {shape(R"("circle": {"radius": 1, "angle": 0})"), "/bodies/0/shapes/0/circle/angle",
         "known here: center, radius"},
        {shape(R"("circle": {"radius": 1}, "filter": {"maks": 1})"), "/bodies/0/shapes/0/filter/maks", "\"mask\"?"},
        {settings(R"("substeps": 4)"), "/settings/substeps", "did you mean \"subSteps\"?"},
        {R"({"view": {"centre": [0, 0], "height": 1}, "bodies": []})", "/view/centre", "did you mean \"center\"?"},
        {joint(kHinge + R"(, "loewr": 1)"), "/joints/0/loewr", "did you mean \"lower\"?"},
        {joint(kHinge + R"(, "length": 1)"), "/joints/0/length", "unknown key"},  // of another type
        {joint(kRod + R"(, "anchor": [0, 0])"), "/joints/0/anchor", "did you mean \"anchorA\"?"},
    });
}

TEST(SceneErrors, WrongTypesAndMissingMembers) {
    expectErrors({
        {"[]", "", "must be an object"},
        {"3", "", "must be an object {…}, not a number"},
        {"{}", "/bodies", "is missing"},
        {R"({"bodies": {}})", "/bodies", "must be an array, not an object"},
        {R"({"bodies": [7]})", "/bodies/0", "must be an object {…}, not a number"},
        {R"({"name": 3, "bodies": []})", "/name", "must be a string, not a number"},
        {R"({"gravity": -9.81, "bodies": []})", "/gravity", "two numbers [x, y], not a number"},
        {R"({"gravity": [0], "bodies": []})", "/gravity", "has 1 element"},
        {R"({"gravity": [0, "down"], "bodies": []})", "/gravity/1", "must be a number, not a string"},
        {R"({"gravity": [0, null], "bodies": []})", "/gravity/1", "must be a number, not null"},
        {R"({"view": {"center": [0, 0]}, "bodies": []})", "/view/height", "is missing"},
        {ball(R"("bullet": 1)"), "/bodies/0/bullet", "must be true or false, not a number"},
        {ball(R"("angle": true)"), "/bodies/0/angle", "must be a number, not true"},
        {ball(R"("mass": null)"), "/bodies/0/mass", "must be a number, not null"},
        {shape(R"("friction": 1)"), "/bodies/0/shapes/0",
         "needs a geometry: \"box\", \"circle\", \"capsule\", \"segment\", \"polygon\" or \"chain\""},
        {shape(R"("box": {"half": [1, 1]}, "circle": {"radius": 1})"), "/bodies/0/shapes/0/circle",
         "this one is a box"},
        {shape(R"("box": {"center": [1, 1]})"), "/bodies/0/shapes/0/box/half", "is missing"},
        {shape(R"("circle": {"center": [1, 1]})"), "/bodies/0/shapes/0/circle/radius", "is missing"},
        {shape(R"("capsule": {"radius": 1})"), "/bodies/0/shapes/0/capsule/points", "is missing"},
        {shape(R"("capsule": {"points": [[0, 0]], "radius": 1})"), "/bodies/0/shapes/0/capsule/points", "two points"},
        {shape(R"("capsule": {"points": [[0, 0], [1, 0]]})"), "/bodies/0/shapes/0/capsule/radius", "is missing"},
        {shape(R"("segment": {"points": []})"), "/bodies/0/shapes/0/segment", "two points"},
        {shape(R"("segment": [[0, 0], [1, 0], [2, 0]])"), "/bodies/0/shapes/0/segment", "has 3 elements"},
        {shape(R"("polygon": [[0, 0], [1]])"), "/bodies/0/shapes/0/polygon/1", "two numbers"},
        {shape(R"("chain": {"loop": true})"), "/bodies/0/shapes/0/chain/points", "is missing"},
        {shape(R"("chain": [[0, 0], [1, 0]])"), "/bodies/0/shapes/0/chain", "must be an object"},
        {joint(R"("bodyA": "floor", "bodyB": "ball")"), "/joints/0/type", "is missing: \"revolute\", \"distance\""},
        {joint(R"("type": "revolute", "bodyA": "floor", "anchor": [0, 0])"), "/joints/0/bodyB", "is missing"},
        {joint(R"("type": "revolute", "bodyA": "floor", "bodyB": "ball")"), "/joints/0/anchor", "is missing"},
        {joint(R"("type": "distance", "bodyA": "floor", "bodyB": "ball", "anchorA": [0, 0])"), "/joints/0/anchorB",
         "is missing"},
        {joint(R"("type": "revolute", "bodyA": 0, "bodyB": "ball", "anchor": [0, 0])"), "/joints/0/bodyA", "a string"},
    });
}

TEST(SceneErrors, WordsAndWholeNumbers) {
    const std::string modes = R"("off", "speedLimit", "speculative", "stop" or "subStep")";
    expectErrors({
        {ball(R"("type": "dynamic")"), "/bodies/0/type", "twice"},
        {wall(R"("type": "Static")"), "/bodies/0/type", R"("static", "kinematic" or "dynamic", not "Static")"},
        {wall(R"("type": 1)"), "/bodies/0/type", R"(must be "static", "kinematic" or "dynamic", not a number)"},
        {settings(R"("continuous": "on")"), "/settings/continuous", modes},
        {settings(R"("continuous": "speculate")"), "/settings/continuous", modes},
        {ball(R"("continuous": 1)"), "/bodies/0/continuous", modes},
        {ball(R"("continuous": "ccd")"), "/bodies/0/continuous", modes},
        {shape(R"("circle": {"radius": 1}, "frictionMixing": "min")"), "/bodies/0/shapes/0/frictionMixing",
         R"(must be "usual", "geometricMean", "average", "minimum", "product" or "maximum", not "min")"},
        {shape(R"("circle": {"radius": 1}, "restitutionMixing": 5)"), "/bodies/0/shapes/0/restitutionMixing",
         R"("product" or "maximum", not a number)"},
        {settings(R"("profile": "slow")"), "/settings/profile", R"(must be "accurate" or "fast", not "slow")"},
        {settings(R"("broadphase": "tree")"), "/settings/broadphase", R"("wideBvh", not "tree")"},
        {settings(R"("subSteps": 2.5)"), "/settings/subSteps", "must be a whole number, not 2.5"},
        {settings(R"("subSteps": 0)"), "/settings/subSteps", "must be from 1 to 1024, not 0"},
        {settings(R"("subSteps": 1025)"), "/settings/subSteps", "must be from 1 to 1024, not 1025"},
        {settings(R"("relaxPasses": -1)"), "/settings/relaxPasses", "from 0 to 64, not -1"},
        {settings(R"("relaxPasses": 65)"), "/settings/relaxPasses", "from 0 to 64, not 65"},
        {settings(R"("maxImpacts": 0)"), "/settings/maxImpacts", "at least 1, not 0"},
        {settings(R"("maxImpacts": 3000000000)"), "/settings/maxImpacts", "to 2147483647, not 3"},
        {settings(R"("maxImpacts": 99999999999)"), "/settings/maxImpacts", "a whole number from 1 to 2147483647, not"},
        {settings(R"("subSteps": 99999999999)"), "/settings/subSteps", "a whole number from 1 to 1024, not"},
        {shape(R"("circle": {"radius": 1}, "filter": {"mask": -1})"), "/bodies/0/shapes/0/filter/mask",
         "from 0 to 4294967295, not -1"},
        {shape(R"("circle": {"radius": 1}, "filter": {"category": 4294967296})"), "/bodies/0/shapes/0/filter/category",
         "from 0 to 4294967295, not 4294967296"},
        {shape(R"("circle": {"radius": 1}, "filter": {"group": 2147483648})"), "/bodies/0/shapes/0/filter/group",
         "from -2147483648 to 2147483647"},
        {joint(R"("type": "revolut", "bodyA": "floor", "bodyB": "ball")"), "/joints/0/type",
         "unknown joint type \"revolut\"; did you mean \"revolute\"?"},
        {joint(R"("type": "elastic")"), "/joints/0/type", "unknown joint type \"elastic\""},
        {joint(R"("type": 3)"), "/joints/0/type", "\"pulley\" or \"filter\", not a number"},
    });
}

std::string ofType(const std::string& type, const std::string& members) {
    return joint(R"("bodyA": "floor", "bodyB": "ball", "type": ")" + type + "\"" + members);
}

TEST(SceneErrors, EveryTypeOfJoint) {
    const std::string at = R"(, "anchor": [0, 0])";
    const std::string gear = R"(, "jointA": "hinge", "jointB": "rod")";
    expectErrors({
        {ofType("prismatic", at), "/joints/0/axis", "is missing"},
        {ofType("prismatic", at + R"(, "axis": [0, 0])"), "/joints/0/axis", "must have a direction"},
        {ofType("wheel", at + R"(, "axis": [0, 1], "lower": 1, "upper": 0)"), "/joints/0/upper", "below lower"},
        {ofType("wheel", at + R"(, "axis": [0, 1], "motorSpeed": 1)"), "/joints/0/motorSpeed", "maxMotorTorque"},
        {ofType("prismatic", at + R"(, "axis": [0, 1], "motorSpeed": 1)"), "/joints/0/motorSpeed", "maxMotorForce"},
        {ofType("weld", at + R"(, "dampingRatio": 1)"), "/joints/0/dampingRatio", "no spring"},
        {ofType("motor", ""), "/joints/0", "needs \"maxForce\" or \"maxTorque\""},
        {ofType("motor", R"(, "maxTorque": 1, "linearOffset": [0, 1])"), "/joints/0/linearOffset", "maxForce"},
        {ofType("motor", R"(, "maxTorque": 1, "angularOffset": 1, "angularVelocity": 1)"), "/joints/0/angularVelocity",
         "one aim"},
        {ofType("mouse", R"(, "target": [0, 1], "dampingRatio": 1)"), "/joints/0/dampingRatio", "no spring"},
        {ofType("mouse", R"(, "target": [0, 1], "maxForce": -1)"), "/joints/0/maxForce", "at least 0"},
        {joint(R"("type": "mouse", "bodyA": "ball", "bodyB": "floor", "target": [0, 1])"), "/joints/0/bodyB",
         "must be dynamic"},
        {ofType("gear", gear), "/joints/0/jointA", "there is no joint"},
        {ofType("gear", gear + R"(, "ratio": 0)"), "/joints/0/ratio", "must not be 0"},
        {ofType("pulley",
                R"(, "groundA": [0, 5], "groundB": [1, 5], "anchorA": [0, 0], "anchorB": [1, 0], "ratio": 0)"),
         "/joints/0/ratio", "greater than 0"},
        {ofType("filter", R"(, "collideConnected": true)"), "/joints/0/collideConnected", "keep its bodies"},
        {ofType("filter", R"(, "breakForce": 1)"), "/joints/0/breakForce", "bears no force"},
        {ofType("filter", at), "/joints/0/anchor", "unknown key"},
    });
}

TEST(SceneErrors, Ranges) {
    expectErrors({
        {settings(R"("dt": 0)"), "/settings/dt", "must be greater than 0, not 0"},
        {settings(R"("dt": 1e-50)"), "/settings/dt", "too small"},
        {settings(R"("maxSpeed": 0)"), "/settings/maxSpeed", "greater than 0"},
        {settings(R"("toiTolerance": 0)"), "/settings/toiTolerance", "greater than 0"},
        {settings(R"("maxPenetration": -1)"), "/settings/maxPenetration", "at least 0, not -1"},
        {settings(R"("maxJointError": -1)"), "/settings/maxJointError", "at least 0"},
        {settings(R"("maxLostTime": -1)"), "/settings/maxLostTime", "at least 0"},
        {settings(R"("sleepSpeed": -1)"), "/settings/sleepSpeed", "at least 0"},
        {R"({"gravity": [1e39, 0], "bodies": []})", "/gravity/0", "1e+39 is too large"},
        {R"({"view": {"height": 0}, "bodies": []})", "/view/height", "greater than 0"},
        {ball(R"("linearDamping": -0.1)"), "/bodies/0/linearDamping", "at least 0, not -0.1"},
        {ball(R"("angularDamping": -2)"), "/bodies/0/angularDamping", "at least 0"},
        {ball(R"("mass": 0)"), "/bodies/0/mass", "greater than 0, not 0"},
        {ball(R"("inertia": -1)"), "/bodies/0/inertia", "greater than 0"},
        {ball(R"("position": [0, -4e38])"), "/bodies/0/position/1", "too large"},
        {shape(R"("circle": {"radius": 0})"), "/bodies/0/shapes/0/circle/radius", "greater than 0"},
        {shape(R"("circle": {"radius": -1})"), "/bodies/0/shapes/0/circle/radius", "greater than 0"},
        {shape(R"("box": {"half": [1, 0]})"), "/bodies/0/shapes/0/box/half/1", "greater than 0"},
        {shape(R"("box": {"half": [1, 1]}, "radius": -0.1)"), "/bodies/0/shapes/0/radius", "at least 0"},
        {shape(R"("box": {"half": [1, 1]}, "density": -1)"), "/bodies/0/shapes/0/density", "at least 0"},
        {shape(R"("box": {"half": [1, 1]}, "friction": -1)"), "/bodies/0/shapes/0/friction", "at least 0"},
        {shape(R"("box": {"half": [1, 1]}, "restitution": 1.01)"), "/bodies/0/shapes/0/restitution",
         "from 0 to 1, not 1.01"},
        {shape(R"("box": {"half": [1, 1]}, "restitution": -0.5)"), "/bodies/0/shapes/0/restitution", "from 0 to 1"},
        {joint(kHinge + R"(, "breakForce": 0)"), "/joints/0/breakForce", "greater than 0"},
        {joint(kHinge + R"(, "breakTorque": -1)"), "/joints/0/breakTorque", "greater than 0"},
        {joint(kHinge + R"(, "motorSpeed": 1, "maxMotorTorque": -1)"), "/joints/0/maxMotorTorque", "at least 0"},
        {joint(kHinge + R"(, "hertz": 0)"), "/joints/0/hertz", "greater than 0"},
        {joint(kHinge + R"(, "hertz": 1, "dampingRatio": -1)"), "/joints/0/dampingRatio", "at least 0"},
        {joint(kRod + R"(, "length": 0)"), "/joints/0/length", "greater than 0"},
        {joint(kRod + R"(, "minLength": -1)"), "/joints/0/minLength", "at least 0"},
        {joint(kRod + R"(, "maxLength": 0)"), "/joints/0/maxLength", "greater than 0"},
    });
}

TEST(SceneErrors, Geometry) {
    const std::string at = "/bodies/0/shapes/0";
    expectErrors({
        {shape(R"("circle": {"radius": 1}, "radius": 0.1)"), at + "/radius", "belongs inside \"circle\""},
        {shape(R"("radius": 0, "circle": {"radius": 1})"), at + "/radius", "not beside it"},
        {shape(R"("capsule": {"points": [[0, 0], [1, 0]], "radius": 1}, "radius": 1)"), at + "/radius", "\"capsule\""},
        {shape(R"("capsule": {"points": [[2, 1], [2, 1]], "radius": 1})"), at + "/capsule/points/1",
         "must differ from the first point [2, 1]"},
        {shape(R"("segment": [[0, 0], [0, 0]])"), at + "/segment/1", "must differ"},
        {shape(R"("polygon": [[0, 0], [1, 0]])"), at + "/polygon", "3 to 8 points, this one has 2"},
        {shape(R"("polygon": [])"), at + "/polygon", "this one has 0"},
        {shape(R"("polygon": [[1,0],[2,0],[3,1],[3,2],[2,3],[1,3],[0,2],[0,1],[-1,1.5]])"), at + "/polygon",
         "this one has 9"},
        {shape(R"("polygon": [[0, 0], [2, 0], [0, 2], [0.5, 0.5]])"), at + "/polygon/3",
         "no vertex of the convex hull"},
        {shape(R"("polygon": [[0, 0], [1, 0], [2, 0], [0, 2]])"), at + "/polygon/1", "[1, 0] is no vertex"},
        {shape(R"("polygon": [[0, 0], [1, 0], [0, 1], [1, 0]])"), at + "/polygon/3", "[1, 0] repeats point 1"},
        {shape(R"("polygon": [[0, 0], [1, 1], [2, 2]])"), at + "/polygon", "lie on a line"},
        {shape(R"("chain": {"points": [[0, 0]]})"), at + "/chain/points", "at least 2 points, this one has 1"},
        {shape(R"("chain": {"points": [[0, 0], [1, 0]], "loop": true})"), at + "/chain/points", "at least 3"},
        {shape(R"("chain": {"points": [[0, 0], [1, 0], [1, 0]]})"), at + "/chain/points/2", "repeats the point before"},
        {shape(R"("chain": {"points": [[0, 0], [1, 0]], "before": [0, 0]})"), at + "/chain/before",
         "repeats the first"},
        {shape(R"("chain": {"points": [[0, 0], [1, 0]], "after": [1, 0]})"), at + "/chain/after", "repeats the last"},
        {shape(R"("chain": {"points": [[0, 0], [1, 0], [1, 1]], "loop": true, "after": [2, 0]})"), at + "/chain/after",
         "a loop has no ends"},
        {shape(R"("chain": {"points": [[0, 0], [1, 0], [1, 1], [0, 0]], "loop": true})"), at + "/chain/points/3",
         "closes by itself"},
        {shape(R"("chain": {"points": [[0, 0], [1, 0]], "surfaces": [{}, {}]})"), at + "/chain/surfaces", "1, not 2"},
        {shape(R"("chain": {"points": [[0, 0], [1, 0]], "surfaces": [{"restitution": 2}]})"),
         at + "/chain/surfaces/0/restitution", "from 0 to 1, not 2"},
        {R"({"bodies": [{"type": "dynamic", "mass": 1, "inertia": 1, "shapes": [{"chain": {"points": [[0, 0], [1, 0]]}}]}]})",
         at + "/chain", "static or kinematic"},
    });
}

TEST(SceneErrors, Bodies) {
    expectErrors({
        {R"({"bodies": [{"name": "a"}, {"name": "b"}, {"name": "a"}]})", "/bodies/2/name", "name of /bodies/0 already"},
        {R"({"bodies": [{"name": "body1"}, {}]})", "/bodies/0/name", "name of the unnamed /bodies/1"},
        {R"({"bodies": [{}, {"name": "body0"}]})", "/bodies/1/name", "name of the unnamed /bodies/0"},
        {R"({"bodies": [{"name": ""}]})", "/bodies/0/name", "must not be empty"},
        {wall(R"("velocity": [1, 0])"), "/bodies/0/velocity", "static body does not move, but has velocity [1, 0]"},
        {wall(R"("angularVelocity": 2)"), "/bodies/0/angularVelocity", "static body does not turn"},
        {wall(R"("mass": 1)"), "/bodies/0/mass", "only a dynamic body has a mass, this one is static"},
        {wall(R"("type": "kinematic", "inertia": 1)"), "/bodies/0/inertia", "this one is kinematic"},
        {ball(R"("fixedRotation": true, "angularVelocity": 1)"), "/bodies/0/angularVelocity", "fixed rotation"},
        {wall(R"("type": "dynamic")"), "/bodies/0", "needs mass"},
        {wall(R"("type": "dynamic", "shapes": [{"segment": [[0, 0], [1, 0]]}])"), "/bodies/0", "its shapes give 0 kg"},
        {wall(R"("type": "dynamic", "shapes": [{"circle": {"radius": 1}, "density": 0}])"), "/bodies/0", "needs mass"},
        {wall(R"("type": "dynamic", "mass": 1)"), "/bodies/0", "needs inertia"},
        {wall(R"("type": "dynamic", "mass": 1, "shapes": [{"segment": [[0, 0], [1, 0]]}])"), "/bodies/0", "inertia"},
        {wall(R"("type": "dynamic", "shapes": [{"circle": {"radius": 1e30}}])"), "/bodies/0", "too large"},
        {wall(R"("type": "dynamic", "shapes": [{"circle": {"radius": 1e-25}}])"), "/bodies/0", "needs mass"},
        {wall(R"("type": "dynamic", "shapes": [{"circle": {"radius": 1e-25}}])"), "/bodies/0",
         "kg is below the smallest allowed, 3.3333333333333334e-39 kg: give it larger shapes"},
        {wall(R"("type": "dynamic", "shapes": [{"circle": {"radius": 1e-12}}])"), "/bodies/0",
         "needs inertia, and 1.57"},
        {wall(R"("type": "dynamic", "mass": 1e-38, "shapes": [{"circle": {"radius": 0.5}}])"), "/bodies/0",
         "needs inertia, and 1.25"},
    });
}

TEST(SceneErrors, Joints) {
    const std::string anchor = R"(, "anchor": [0, 0])";
    expectErrors({
        {joint(R"("type": "revolute", "bodyA": "flor", "bodyB": "ball")" + anchor), "/joints/0/bodyA",
         "there is no body \"flor\"; did you mean \"floor\"?"},
        {joint(R"("type": "revolute", "bodyA": "floor", "bodyB": "body9")" + anchor), "/joints/0/bodyB", "no body"},
        {joint(R"("type": "revolute", "bodyA": "floor", "bodyB": "body2")" + anchor), "/joints/0/bodyB", "no body"},
        {joint(R"("type": "revolute", "bodyA": "ball", "bodyB": "ball")" + anchor), "/joints/0/bodyB", "must differ"},
        {joint(R"("type": "revolute", "bodyA": "floor", "bodyB": "wall")" + anchor), "/joints/0/bodyB",
         "needs a dynamic body, neither \"floor\" nor \"wall\" is one"},
        {joint(kHinge + R"(}, {"name": "joint0", )" + kRod), "/joints/1/name", "unnamed /joints/0"},
        {joint(R"("name": "", )" + kHinge), "/joints/0/name", "must not be empty"},
        {joint(kHinge + R"(, "lower": 1, "upper": 0.5)"), "/joints/0/upper", "0.5 is below lower 1"},
        {joint(kHinge + R"(, "motorSpeed": 1)"), "/joints/0/motorSpeed", "maxMotorTorque"},
        {joint(kHinge + R"(, "dampingRatio": 0.5)"), "/joints/0/dampingRatio", "no spring"},
        {joint(kRod + R"(, "minLength": 3, "maxLength": 2)"), "/joints/0/maxLength", "2 is below minLength 3"},
        {joint(kRod + R"(, "minLength": 3, "length": 2)"), "/joints/0/length", "2 is below minLength 3"},
        {joint(kRod + R"(, "length": 3, "maxLength": 2)"), "/joints/0/maxLength", "2 is below length 3"},
        {joint(kRodFrom + "[0, 1]"), "/joints/0/anchorB", "must differ from anchorA [0, 1]"},
        {joint(kRodFrom + R"([0, 1], "maxLength": 2, "hertz": 3)"), "/joints/0/anchorB", "or \"length\" be given"},
    });
}

TEST(SceneErrors, FirstErrorInTheOrderOfTheDocument) {
    expectErrors({
        {R"({"gravity": "up", "bodies": [{"angle": "x"}]})", "/gravity", "two numbers"},
        {R"({"bodies": [{"angle": "x"}], "gravity": "up"})", "/bodies/0/angle", "a number"},
        {R"({"bodies": [{"velocity": [1, 0]}, {"type": "dynamic"}]})", "/bodies/0/velocity", "static"},
    });
}

TEST(SceneErrors, ScenesMadeInCodeAreValidatedToo) {
    SceneDescription scene;
    scene.bodies.resize(1);
    EXPECT_FALSE(validateScene(scene).has_value());
    scene.gravity.x = std::numeric_limits<double>::quiet_NaN();
    ASSERT_TRUE(validateScene(scene).has_value());
    EXPECT_EQ(validateScene(scene)->pointer, "/gravity/0");
    EXPECT_EQ(validateScene(scene)->reason, "must be finite, not nan");
    scene.gravity.x = 0;
    scene.bodies[0].position.y = -std::numeric_limits<double>::infinity();
    EXPECT_EQ(validateScene(scene)->pointer, "/bodies/0/position/1");
    EXPECT_EQ(validateScene(scene)->reason, "must be finite, not -inf");
    scene.bodies[0].position.y = 0;
    ShapeDescription circle;
    circle.geometry = CircleGeometry{{}, 1};
    circle.radius = 0.5;
    scene.bodies[0].shapes.push_back(circle);
    EXPECT_EQ(validateScene(scene)->pointer, "/bodies/0/shapes/0/radius");
}

TEST(SceneErrors, LargeNumbersAreAQuestionOfPrecision) {
    SceneDescription scene;
    scene.gravity.y = -1e200;
    ASSERT_TRUE(validateScene(scene).has_value());
    EXPECT_EQ(validateScene(scene)->pointer, "/gravity/1");
    EXPECT_FALSE(validateScene(scene, std::numeric_limits<double>::max()).has_value());
}

TEST(SceneErrors, OfTheWholeDocument) {
    EXPECT_EQ(readScene("[]", "bad.json").error.text(), "bad.json: a scene must be an object {…}, not an array");
}

TEST(SceneErrors, FilesThatCannotBeRead) {
    const SceneResult missing = readSceneFile("no/such/scene.json");
    EXPECT_FALSE(missing.scene.has_value());
    EXPECT_EQ(missing.error.text(), "no/such/scene.json: cannot be read: No such file or directory");
    const SceneResult folder = readSceneFile("/");
    EXPECT_EQ(folder.error.text(), "/: is a folder, not a scene file");
}

}  // namespace
}  // namespace swept
