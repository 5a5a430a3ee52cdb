//! The executive: runs a plan on a robot, tier by tier. It may hold the room map and the robot's sensors, never the scene.
