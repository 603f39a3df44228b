// Files of meshes are read as they are, or refused at the place of their fault.

#include "geometry/mesh_file.h"

#include <fstream>
#include <random>
#include <set>

#include "geometry/mesh.h"
#include "tests/geometry/mesh_samples.h"
#include "tests/support/catch.h"
#include "tests/support/folder.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::geometry;
using namespace vkdose::test;

namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

/// The message by which a file is refused; empty if it is taken. Anything but a MeshError fails the test.
std::string refusal(const NamedFile& file) {
    try {
        makeMesh(readMesh(file.content, file.name, 1e-3));
    } catch (const MeshError& e) {
        return e.what();
    }
    return "";
}

}  // namespace

TEST_CASE("every form of file gives the same mesh") {
    const Sample s = cube();
    for (const NamedFile& file : everyForm(s)) {
        CAPTURE(file.name);
        const TriangleSoup soup = readMesh(file.content, file.name, 1e-3);
        REQUIRE(soup.triangles.size() == 12);
        for (std::size_t t = 0; t < 12; ++t)
            for (int i = 0; i < 3; ++i)
                CHECK(near(soup.points[soup.triangles[t][i]], 1e-3 * s.points[s.triangles[t][i]], 1e-3, 0));
        const MeshFacts facts = makeMesh(soup).facts;
        CHECK(facts.vertices == 8);
        CHECK(facts.edges == 18);
        CHECK(facts.closed);
        CHECK(facts.oriented);
        CHECK(nearRelative(facts.volume, 1e-9, 1e-12));
        CHECK(nearRelative(facts.area, 6e-6, 1e-12));
    }
}

TEST_CASE("a file on disk is read, and one that is not there is refused") {
    const Folder folder;
    std::ofstream(folder / "cube.stl", std::ios::binary) << binaryStl(cube());
    CHECK(readMeshFile(folder / "cube.stl", 1).triangles.size() == 12);
    CHECK_THROWS_AS(readMeshFile(folder / "none.stl", 1), MeshError);
    CHECK_THROWS_AS(readMeshFile(folder.path(), 1), MeshError);
}

TEST_CASE("what the formats allow is read") {
    const Sample s = cube();
    // Two solids, capitals, tabs, ends of lines from Windows, a plus sign, no name.
    std::string stl = asciiStl(s);
    std::string other;
    for (const char c : replaced(replaced(stl, "solid cube", "SOLID"), "vertex 0 0 0", "VERTEX\t+0 -0.0 0e3"))
        other += c == '\n' ? std::string("\r\n") : std::string(1, c);
    CHECK(readMesh(other + stl, "x.stl", 1).triangles.size() == 24);
    // A binary file may begin with "solid".
    std::string binary = binaryStl(s);
    CHECK(readMesh(binary.replace(0, 5, "solid"), "x.STL", 1).triangles.size() == 12);
    // Quadrangles, counted from behind.
    const TriangleSoup flat = readMesh("v 0 0 0 1\nv 1 0 0\nv 1 1 0 0.5 0.5 0.5\nv 0 1 0\nf -4 -3 -2 -1\n", "x.obj", 1);
    CHECK(flat.triangles.size() == 2);
    CHECK(flat.place(1) == "x.obj:5");
    // A further element before and behind, and a further list.
    std::string ply = asciiPly(s);
    ply = replaced(ply, "element vertex", "element camera 2\nproperty list uchar float view\nelement vertex");
    ply =
        replaced(ply, "end_header\n", "element material 1\nproperty double shine\nend_header\n2 0.5 0.5\n0\n") + "7\n";
    CHECK(readMesh(ply, "x.ply", 1).triangles.size() == 12);
}

TEST_CASE("a hundred broken files and more are refused at the place of the fault") {
    const Sample s = cube();
    std::vector<NamedFile> broken;
    // Cut short anywhere but in the last statement. An OBJ has no end, so a shorter one may be whole.
    for (const NamedFile& file : everyForm(s)) {
        if (file.name == "c.obj") continue;
        const std::size_t end = file.content.size() - (file.name == "a.stl" ? 15 : file.name == "d.ply" ? 2 : 1);
        for (std::size_t cut = 0; cut < end; cut += 1 + end / 40)
            broken.push_back({file.name, file.content.substr(0, cut)});
        broken.push_back({file.name, file.content.substr(0, end)});
        if (file.name.find("stl") == std::string::npos) broken.push_back({file.name, file.content + "1 2"});
        if (file.name != "a.stl") broken.push_back({file.name, file.content + std::string(50, '1')});
    }
    // Numbers that are none, or none that can be used.
    for (const char* bad : {"nan", "inf", "-inf", "1e400", "abc", "0,5", "0x1", "--1", "1e", "1e300", "+-1"}) {
        broken.push_back({"a.stl", replaced(asciiStl(s), "vertex 1 0 0", fmt::format("vertex 1 {} 0", bad))});
        broken.push_back({"c.obj", replaced(obj(s), "v 1 0 0", fmt::format("v 1 {} 0", bad))});
        broken.push_back({"d.ply", replaced(asciiPly(s), "\n1 0 0", fmt::format("\n1 {} 0", bad))});
        const std::string text = bad;  // of a normal only that it is there has a meaning
        if (text != "1e300" && text != "nan" && text.find("inf") == std::string::npos)
            broken.push_back({"a.stl", replaced(asciiStl(s), "normal 0 0", fmt::format("normal {} 0", bad))});
    }
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    for (const float bad : {nan, inf, -inf, 1e30F})
        for (const std::size_t at : {96U, 100U, 128U, 658U}) {
            std::string binary = binaryStl(s);
            broken.push_back({"b.stl", binary.replace(at, 4, floatBytes(bad))});
        }
    // Counts that lie.
    for (const std::uint32_t count : {0U, 1U, 11U, 13U, 0x7fffffffU, 0xffffffffU}) {
        std::string binary = binaryStl(s);
        broken.push_back({"b.stl", binary.replace(80, 4, bytesOf(count))});
    }
    for (const char* count : {"0", "7", "9", "-1", "8.5", "eight", "99999999999", "9223372036854775807", ""})
        for (const auto& text : {asciiPly(s), binaryPly(s, true), binaryPly(s, false)})
            broken.push_back({"d.ply", replaced(text, "vertex 8", fmt::format("vertex {}", count))});
    for (const char* count : {"0", "11", "13", "-1", "4294967295", "18446744073709551616"})
        for (const auto& text : {asciiPly(s), binaryPly(s, true), binaryPly(s, false)})
            broken.push_back({"d.ply", replaced(text, "face 12", fmt::format("face {}", count))});
    // By hand.
    const auto edit = [&](const char* name, const std::string& text, const char* from, const char* to) {
        broken.push_back({name, replaced(text, from, to)});
    };
    const std::string stl = asciiStl(s), wave = obj(s), ply = asciiPly(s);
    edit("a.stl", stl, "facet normal", "facet");
    edit("a.stl", stl, "outer loop", "outer");
    edit("a.stl", stl, "outer loop", "inner loop");
    edit("a.stl", stl, "endloop", "vertex 1 1 1\nendloop");
    edit("a.stl", stl, "endfacet", "endloop");
    edit("a.stl", stl, "vertex 0 0 0", "vertex 0 0");
    edit("a.stl", stl, "vertex 0 0 0", "vertex 0 0 0 0");
    edit("a.stl", stl, "vertex 0 0 0", "vertices 0 0 0");
    edit("a.stl", stl, "solid cube", "cube");
    edit("a.stl", stl, "endsolid cube", "endsolid cube\nrest");
    edit("a.stl", stl, "endsolid cube", "solid cube");
    edit("a.stl", stl, "endfacet", "endfacet\nendloop");
    broken.push_back({"a.stl", "solid nothing\nendsolid nothing\n"});
    broken.push_back({"a.stl", "<html>not found</html>"});
    broken.push_back({"a.stl", std::string(2000, '\0')});
    broken.push_back({"a.stl", std::string(2000, 'x')});
    broken.push_back({"a.stl", wave});
    edit("c.obj", wave, "f 1 ", "f 0 ");
    edit("c.obj", wave, "f 1 ", "f 9 ");
    edit("c.obj", wave, "f 1 ", "f -9 ");
    edit("c.obj", wave, "f 1 ", "f 99999999999999999999 ");
    edit("c.obj", wave, "f 1 ", "f 1.5 ");
    edit("c.obj", wave, "f 1 ", "f a ");
    edit("c.obj", wave, "f 1 ", "f / ");
    edit("c.obj", wave, "f 1 3//1 4/2/3", "f 1 3");
    edit("c.obj", wave, "f 1 3//1 4/2/3", "f");
    edit("c.obj", wave, "f 1 3//1 4/2/3", "f 1 4 3 2");  // crosses itself
    edit("c.obj", wave, "f 1 3//1 4/2/3", "f 1 2 4 7");  // not flat
    edit("c.obj", wave, "v 0 0 0", "v 0 0");
    edit("c.obj", wave, "v 0 0 0", "v 0 0 0 2");
    edit("c.obj", wave, "v 0 0 0", "v 0 0 0 1 1");
    edit("c.obj", wave, "v 0 0 0", "vv 0 0 0");
    edit("c.obj", wave, "o cube", "call c.obj");  // an OBJ may call a file, and so itself
    edit("c.obj", wave, "o cube", "curv 0 1 1 2 3");
    edit("c.obj", wave, "o cube", "surf 0 1 0 1 1 2 3");
    edit("c.obj", wave, "o cube", "f 1 2 3");  // before the points
    edit("c.obj", wave, "v 0 0 0", "v 0 0 \\\n0");
    broken.push_back({"c.obj", "# nothing\n"});
    broken.push_back({"c.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"});
    broken.push_back({"c.obj", stl});
    broken.push_back({"c.obj", std::string("v 0 0 0\0\n", 9) + wave});
    edit("d.ply", ply, "ply\n", "plx\n");
    edit("d.ply", ply, "ascii 1.0", "ascii 2.0");
    edit("d.ply", ply, "format ascii 1.0\n", "");
    edit("d.ply", ply, "format ascii 1.0", "format text 1.0");
    edit("d.ply", ply, "float x", "float u");
    edit("d.ply", ply, "float x", "float y");
    edit("d.ply", ply, "float x", "half x");
    edit("d.ply", ply, "float x", "list uchar float x");
    edit("d.ply", ply, "float x", "float");
    edit("d.ply", ply, "element vertex 8", "element point 8");
    edit("d.ply", ply, "element vertex 8\n", "");
    edit("d.ply", ply, "element face 12", "element vertex 12");
    edit("d.ply", ply, "list uchar int vertex_indices", "int vertex_indices");
    edit("d.ply", ply, "list uchar int", "list float int");
    edit("d.ply", ply, "list uchar int", "list uchar float");
    edit("d.ply", ply, "vertex_indices", "corners");
    edit("d.ply", ply, "end_header\n", "");
    edit("d.ply", ply, "end_header\n", "element tristrips 0\nproperty list int int vertex_indices\nend_header\n");
    edit("d.ply", ply, "end_header\n", "element void 5\nend_header\n");
    edit("d.ply", ply, "end_header\n", "property list uchar\nend_header\n");
    edit("d.ply", ply, "end_header\n", "what is this\nend_header\n");
    edit("d.ply", ply, "3 0 2 3\n", "3 0 2 8\n");
    edit("d.ply", ply, "3 0 2 3\n", "3 0 2 -1\n");
    edit("d.ply", ply, "3 0 2 3\n", "3 0 2 2.5\n");
    edit("d.ply", ply, "3 0 2 3\n", "2 0 2\n");
    edit("d.ply", ply, "3 0 2 3\n", "-3 0 2 3\n");
    edit("d.ply", ply, "3 0 2 3\n", "4000000000 0 2 3\n");
    edit("d.ply", ply, "3 0 2 3\n", "0\n");
    edit("d.ply", ply, "3 0 2 3\n", "4 0 3 2 1\n");
    for (const char* type : {"float", "double"}) {
        broken.push_back({"e.ply", replaced(binaryPly(s, true), "uchar red", fmt::format("{} red", type))});
        broken.push_back({"f.ply", replaced(binaryPly(s, false), "uchar red", fmt::format("{} red", type))});
    }
    edit("e.ply", binaryPly(s, true), "binary_little_endian", "binary_big_endian");
    edit("e.ply", binaryPly(s, false), "binary_big_endian", "binary_little_endian");
    broken.push_back({"g.step", "ISO-10303-21;"});
    broken.push_back({"noname", asciiStl(s)});

    CHECK(broken.size() >= 300);
    for (const NamedFile& file : broken) {
        const std::string said = refusal(file);
        CAPTURE(file.name, file.content.substr(0, 300), said);
        CHECK_THAT(said, Catch::StartsWith(file.name + ":"));
        CHECK(said.size() < 400);
    }
}

TEST_CASE("normals in an STL have no meaning, whatever stands there") {
    const Sample s = cube();
    for (const char* normal : {"nan nan nan", "-nan -nan -nan", "NaN 0 0", "-nan(ind) -nan(ind) -nan(ind)",
                               "inf -inf 0", "1.#QNAN -1.#IND 1.#INF", "0 0 0", "1e-40 0 -1e-310", "7 7 7"}) {
        CAPTURE(normal);
        std::string text = asciiStl(s);
        for (std::size_t at = 0; (at = text.find("normal 0 0 0", at)) != std::string::npos; at += 8)
            text.replace(at, 12, fmt::format("normal {}", normal));
        CHECK(makeMesh(readMesh(text, "a.stl", 1)).facts.volume ==
              makeMesh(readMesh(asciiStl(s), "a.stl", 1)).facts.volume);
    }
    for (const float normal :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e-44F}) {
        std::string bytes = binaryStl(s);
        for (std::size_t at = 84; at < bytes.size(); at += 50)
            for (std::size_t d = 0; d < 3; ++d) bytes.replace(at + 4 * d, 4, floatBytes(normal));
        CHECK(near(makeMesh(readMesh(bytes, "b.stl", 1)).facts.volume, 1, 1, 1e-12));
    }
}

TEST_CASE("marks, comments, ends of lines and padding around a mesh are passed over") {
    const Sample s = cube();
    const auto triangles = [](const std::string& name, const std::string& content) {
        return readMesh(content, name, 1).triangles.size();
    };
    const std::string mark = "\xef\xbb\xbf", stl = asciiStl(s);
    for (const NamedFile& file : everyForm(s))
        if (file.name != "b.stl") CHECK(triangles(file.name, mark + file.content) == 12);
    CHECK(triangles("a.stl", "# by hand\n\n// of a cube\n" + stl + "# the end\n; really\n") == 12);
    CHECK(triangles("a.stl", mark + "# by hand\n" + stl) == 12);
    CHECK(triangles("a.stl", replaced(stl, "  facet", "  # the first side\n  facet")) == 12);
    CHECK(triangles("a.stl", stl + std::string("\x1a\0\0\0", 4)) == 12);
    CHECK(triangles("c.obj", "# by hand\n" + obj(s) + "# the end\n") == 12);
    for (const char* end : {"\r\n", "\r"})
        for (const auto& [name, content] : everyForm(s)) {
            if (name == "b.stl") continue;
            // The lines of a header, or of all of the text.
            const bool binary = name == "e.ply" || name == "f.PLY";
            const std::size_t text = binary ? content.find("end_header\n") + 11 : content.size();
            std::string other;
            for (std::size_t i = 0; i < content.size(); ++i)
                other += i < text && content[i] == '\n' ? std::string(end) : std::string(1, content[i]);
            CAPTURE(name, int(end[1]));
            CHECK(makeMesh(readMesh(other, name, 1)).facts.volume == makeMesh(readMesh(content, name, 1)).facts.volume);
        }
    // A fault is told with the line that an editor shows.
    std::string mac;
    for (const char c : replaced(stl, "vertex 1 1 0", "vertex 1 one 0")) mac += c == '\n' ? '\r' : c;
    CHECK(refusal({"a.stl", mac}) == "a.stl:6: vertex: 'one' is not a number; three numbers belong here");
    for (const char* name : {"e.ply", "f.PLY"})
        CHECK(triangles(name, binaryPly(s, name[0] == 'e') + std::string("\0\0\n\0", 4)) == 12);
}

TEST_CASE("a binary STL may be longer than its triangles, and what is behind them is told") {
    const std::string good = binaryStl(cube());
    const auto told = [](const std::string& content) { return makeMesh(readMesh(content, "b.stl", 1)).facts.mended; };
    CHECK(told(good).empty());
    CHECK(told(good + "\n") == "1 byte behind the last triangle passed over");
    CHECK(told(good + "made by CAD") == "11 bytes behind the last triangle passed over");
    CHECK(told(good + std::string(49, 'x')) == "49 bytes behind the last triangle passed over");
    CHECK(told(good + std::string(512, '\0')) == "512 bytes behind the last triangle passed over");
    // So many may be triangles that the number at byte 80 does not count.
    CHECK(
        refusal({"b.stl", good + std::string(50, 'x')}) ==
        "b.stl: byte 684: the 12 announced triangles end here, and 50 bytes follow; the number at byte 80 is wrong, or "
        "something was appended. Export the mesh again");
    std::string solid = good;
    CHECK(told(solid.replace(0, 11, "solid of it") + "\r\n") == "2 bytes behind the last triangle passed over");
}

TEST_CASE("a mesh of another kind than its name says is told as one") {
    CHECK(refusal({"a.stl", obj(cube())}) ==
          "a.stl:2: 'o' stands where 'solid' belongs; the file is damaged or no STL");
    CHECK_THAT(refusal({"a.stl", std::string("\xff\xfes\0o\0l\0i\0d\0", 12)}), Catch::Contains("UTF-16"));
}

TEST_CASE("long headers and long lines are read in one go") {
    // With a search through all before it for each property, element or line this would take hours.
    const Sample s = cube();
    std::string header, values;
    for (int i = 0; i < 300000; ++i) {
        header += fmt::format("property uchar p{}\n", i);
        values += " 7";
    }
    std::string ply = replaced(asciiPly(s), "property uchar red\n", header);
    const std::size_t data = ply.find("end_header\n") + 11;
    std::string body = ply.substr(data);
    ply.resize(data);
    for (std::size_t v = 0; v < s.points.size(); ++v) body.replace(body.find(" 7\n"), 3, values + "\n");
    CHECK(readMesh(ply + body, "a.ply", 1).triangles.size() == 12);
    std::string elements;
    for (int i = 0; i < 200000; ++i) elements += fmt::format("element e{} 0\nproperty uchar p\n", i);
    CHECK(readMesh(replaced(asciiPly(s), "end_header", elements + "end_header"), "a.ply", 1).triangles.size() == 12);

    constexpr int kCorners = 200000;  // of one polygon
    std::string disc, face = "f";
    for (int i = 0; i < kCorners; ++i) {
        disc += fmt::format("v {} {} 0\n", std::cos(2 * kPi * i / kCorners), std::sin(2 * kPi * i / kCorners));
        face += fmt::format(" {}", i + 1);
    }
    CHECK(readMesh(disc + face, "c.obj", 1).triangles.size() == kCorners - 2);
    std::string solids;
    for (int i = 0; i < 20000; ++i) solids += asciiStl({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    CHECK(readMesh(solids, "a.stl", 1).triangles.size() == 20000);
}

TEST_CASE("messages name the place and what would be right") {
    const Sample s = cube();
    CHECK(refusal({"a.stl", replaced(asciiStl(s), "vertex 1 1 0", "vertex 1 one 0")}) ==
          "a.stl:6: vertex: 'one' is not a number; three numbers belong here");
    CHECK(
        refusal({"b.stl", binaryStl(s).substr(0, 400)}) ==
        "b.stl: byte 80: 12 triangles are announced, which take 684 bytes, but the file has 400; it was cut off or is "
        "no binary STL");
    CHECK(refusal({"c.obj", replaced(obj(s), "f 1 ", "f 9 ")}) ==
          "c.obj:11: a face names point 9, and 8 stand before it");
    CHECK(refusal({"e.ply", binaryPly(s, true).substr(0, 300)}) ==
          "e.ply: byte 300: the file ends before the announced data");
    CHECK(refusal({"d.ply", replaced(asciiPly(s), "3 0 2 3\n", "3 0 \033[2J 3\n")}) ==
          "d.ply:20: '\\x1b[2J' is not a number");
    CHECK_THAT(refusal({"c.obj", replaced(obj(s), "v 1 0 0", "v 1 1e12 0")}),
               Catch::Contains("1e+09 m, at 0.001 m per unit"));
}

TEST_CASE("a file that was damaged anywhere is taken or refused, and nothing else happens") {
    std::mt19937_64 random(17);
    int refused = 0;
    for (const NamedFile& file : everyForm(cube()))
        for (int n = 0; n < 300; ++n) {
            NamedFile damaged = file;
            for (std::uint64_t changes = 1 + random() % 3; changes > 0; --changes) {
                const std::size_t at = random() % damaged.content.size();
                switch (random() % 3) {
                    case 0:
                        damaged.content[at] = static_cast<char>(random() & 0xffU);
                        break;
                    case 1:
                        damaged.content.erase(at, 1 + random() % 20);
                        break;
                    default:
                        damaged.content.insert(at, damaged.content.substr(random() % damaged.content.size(), 9));
                }
                if (damaged.content.empty()) damaged.content = " ";
            }
            const std::string said = refusal(damaged);
            CAPTURE(file.name, n, said);
            if (said.empty()) continue;
            CHECK_THAT(said, Catch::StartsWith(file.name + ":"));
            ++refused;
        }
    CHECK(refused > 900);
}

TEST_CASE("units have names") {
    CHECK(metresIn("mm") == 1e-3);
    CHECK(metresIn("inch") == 0.0254);
    CHECK(!metresIn("MM"));
    CHECK(!metresIn(""));
    CHECK(lengthUnits() == "m, cm, mm, um, inch");
    for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
        CHECK_THROWS_AS(readMesh(asciiStl(cube()), "a.stl", bad), MeshError);
}
