#include "import/other_clips.h"

#include <map>

#include "model/core/index.h"

namespace contort {

int add_clips(const Asset& from, Asset& into) {
  std::map<std::string, int> index;
  for (std::size_t i = 0; i < into.nodes.size(); ++i) index[into.nodes[i].label] = static_cast<int>(i);
  int added = 0;
  for (const AssetClip& clip : from.clips) {
    AssetClip own = clip;
    own.channels.clear();
    std::size_t turns = 0;
    for (const AssetChannel& channel : clip.channels) {
      if (channel.path != ChannelPath::rotation) continue;
      ++turns;
      const auto node = index.find(from.nodes[at(channel.node)].label);
      if (node == index.end()) continue;
      own.channels.push_back(channel);
      own.channels.back().node = node->second;
    }
    if (own.channels.empty() || 2 * own.channels.size() < turns) continue;
    into.clips.push_back(std::move(own));
    ++added;
  }
  return added;
}

}  // namespace contort
