// SPDX-License-Identifier: BSD-3-Clause
// Centres of mass: a ball whose volume is that of the mass at 1000 kg/m^3.
import { InstancedMesh, Matrix4, MeshBasicMaterial, SphereGeometry, Group } from "three";

const DENSITY = 1000; // kg/m^3

export const centres = {
  id: "centres",
  title: "Centres of mass",
  key: "m",
  on: false,
  create(app) {
    const group = new Group();
    const geometry = new SphereGeometry(1, 16, 10);
    const material = new MeshBasicMaterial({ color: 0xc58af9, transparent: true, opacity: 0.75, depthTest: false });
    let mesh = null;
    let links = [];
    let stale = true;
    app.scene.on("changed", () => (stale = true));
    const local = new Matrix4();
    const world = new Matrix4();
    return {
      object3d: group,
      update() {
        if (stale) {
          stale = false;
          group.clear();
          links = [...app.scene.objects.values()].filter((object) => object.kind === "link" && !object.static);
          mesh = new InstancedMesh(geometry, material, Math.max(links.length, 1));
          mesh.count = links.length;
          mesh.frustumCulled = false;
          mesh.renderOrder = 4;
          group.add(mesh);
        }
        links.forEach((link, place) => {
          const radius = Math.cbrt((3 * link.mass) / (4 * Math.PI * DENSITY));
          local.makeScale(radius, radius, radius).setPosition(...link.centre_of_mass);
          mesh.setMatrixAt(place, app.view.matrixOf(link, world).multiply(local));
        });
        mesh.instanceMatrix.needsUpdate = true;
      },
    };
  },
};
