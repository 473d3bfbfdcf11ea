// A program that reads a robot: what it links comes with cardan::urdf.
#include <cardan/mbs/urdf/urdf.hpp>

#include <iostream>

int main() {
    const cardan::UrdfModel robot = cardan::parse_urdf(R"(
        <robot name="pendulum">
          <link name="ground"/>
          <link name="bob">
            <inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
          </link>
          <joint name="hinge" type="continuous"><parent link="ground"/><child link="bob"/></joint>
        </robot>)");
    const double mass = cardan::Model(robot.tree).mass();
    std::cout << robot.robot_name << " of " << mass << " kg\n";
    return mass == 2 ? 0 : 1;
}
