//! What a robot's eyes report: furniture with pose, and the object. Nothing here may look at the scene.
