// The numbers of the material, as constants() in cpp/cubecam/materials/standard.cpp writes them.
// A mesh without uvs has no tangents, so it shows no map and stretches no highlight.
#ifndef USES_TANGENT
#undef ANISOTROPY
#undef HAS_NORMAL_MAP
#undef HAS_CLEARCOAT_NORMAL_MAP
#endif

#define COLOR material[0]
#define METALLIC material[1].x
#define ROUGHNESS material[1].y
#define NORMAL_SCALE material[1].z
#define ALPHA_CUTOFF material[1].w
#define EMISSIVE material[2].rgb  // times the strength
#define OCCLUSION_STRENGTH material[2].a
#define DIELECTRIC_F0 material[3].rgb  // of the index of refraction, times the specular colour; not yet limited to 1
#define SPECULAR_WEIGHT material[3].a
#define AMBIENT material[4].rgb  // the sum of the scene's ambient lights
#define SPECULAR_SAMPLES material[4].a
#define COAT material[5].x
#define COAT_ROUGHNESS material[5].y
#define COAT_NORMAL_SCALE material[5].z
#define ANISOTROPY_STRENGTH material[5].w
#define SHEEN_COLOR material[6].rgb
#define SHEEN_ROUGHNESS material[6].a
#define IRIDESCENCE_SHARE material[7].x
#define IRIDESCENCE_IOR material[7].y
#define IRIDESCENCE_THICKNESS material[7].zw  // least, greatest; nanometres
#define ANISOTROPY_TURN material[8].xy  // cosine, sine
#define TRANSMISSION_SHARE material[8].z
#define THICKNESS material[8].w
#define EXTINCTION material[9].rgb  // for a world unit
#define ETAS material[10].rgb  // n_outside / n_inside for red, green and blue
#define TRANSMISSION_BLUR material[10].a  // factor of the roughness
#define FIRST_PLACE 12  // two rows of a matrix for each map; the first row's w: the set of uvs
