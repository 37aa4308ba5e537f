// The parts of three that page.js uses: `make web` bundles them into one file.
export {
    AmbientLight, BoxGeometry, BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, DynamicDrawUsage, Group,
    InstancedMesh, InterleavedBuffer, InterleavedBufferAttribute, LineBasicMaterial, LineLoop, LineSegments, Matrix4, Mesh,
    MeshBasicMaterial, MeshLambertMaterial, PerspectiveCamera, Plane, Raycaster, Scene, ShaderMaterial, Sphere, SphereGeometry,
    Vector2, Vector3, WebGLRenderer,
} from 'three';
